// SPDX-License-Identifier: GPL-3.0-or-later
// Intermediate model of the Nastran reader: cards by name, grid points by id, and coordinate systems.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reducer/decks/deck.hpp"
#include "reducer/decks/nastran/coordinates.hpp"
#include "reducer/decks/nastran/fields.hpp"
#include "reducer/decks/nastran/ids.hpp"
#include "reducer/decks/nastran/materials.hpp"
#include "reducer/decks/nastran/properties.hpp"
#include "reducer/decks/nastran/remarks.hpp"

namespace tisserand::reducer {

/// Defaults that GRDSET gives for blank fields of GRID.
struct GridDefaults {
  int position_frame = 0;
  int displacement_frame = 0;
  Components fixed = 0;
};

/// Components of a node that the deck holds to ground, along the axes of the CD field of its GRID.
struct HeldNode {
  int node = 0;
  Components components = 0;
  std::size_t card = 0;  ///< index in NastranCards::cards
};

/// Contents of a Nastran deck while it is converted to a mesh.
struct NastranModel {
  NastranCards cards;
  DeckFaults faults;
  NastranRemarks remarks;  ///< remarks, which become warnings of the mesh
  /// Indices of cards by name, in capitals; in the order of the deck.
  std::map<std::string, std::vector<std::size_t>> rows;
  NastranFrames frames;
  IdTable grid_rows;          ///< table from the id of a GRID to its node in the mesh
  std::vector<long> grid_id;  ///< id of the GRID of each node; the next three members also have one entry per node
  std::vector<std::size_t> grid_card;
  std::vector<int> displacement_frame;  ///< frame of the displacements of each node, as index in `frames`
  std::vector<Components> fixed;        ///< components that PS holds to ground
  double mass_scale = 1.0;              ///< factor of all masses (PARAM,WTMASS)
  formats::MassMatrix mass_matrix = formats::MassMatrix::lumped;  ///< kind of mass matrix (PARAM,COUPMASS)
  NastranMaterials materials;
  NastranProperties properties;
  std::map<long, ElementSet> of_property;                  ///< elements of each property; key: PID
  std::vector<std::pair<long, std::size_t>> element_card;  ///< id and card of each element, to find duplicate ids
  std::vector<HeldNode> held;
  std::set<std::string> reported;  ///< sets that case control does not select and a remark has named
  Deck deck;

  /// Calls action(CardFields&) for every card with this name, in capitals.
  template <class Action>
  void for_each(const std::string& name, const Action& action) {
    const auto found = rows.find(name);
    if (found == rows.end()) return;
    for (const std::size_t row : found->second) {
      CardFields fields = card(row);
      action(fields);
    }
  }

  /// Fields of the card with the index `row` in NastranCards::cards. row() gives the index of a card.
  CardFields card(std::size_t row) { return {cards, cards.cards[row], faults}; }
  std::size_t row(const CardFields& fields) const {
    return static_cast<std::size_t>(&fields.card() - cards.cards.data());
  }

  /// Node of the GRID whose id is in the field `index`; −1 after a fault (no number, or no such GRID).
  int node(CardFields& fields, int index, std::string_view name);

  /// Node of the GRID with the id `id`; −1 after a fault.
  int node_of(CardFields& fields, long id, std::string_view name);

  /// Axes of the displacements of a node (columns, part axes), from the CD field of its GRID.
  Eigen::Matrix3d displacement_axes(int node) const;

  /// Element id in the field `index`, which is also recorded to find duplicate ids.
  int element_id(CardFields& fields, int index = 0);

  /// Whether the set of SPC or MPC of the card, in its field 0, is active. Without case control all sets are.
  /// Otherwise those are that case control selects, also through SPCADD or MPCADD. A remark names the others. `kind`:
  /// "SPC" or "MPC".
  bool holds(CardFields& fields, const std::string& kind);

  /// Index in `frames` of the coordinate system whose id is in the field `index` (blank: 0, the basic system); −1
  /// after a fault.
  int frame(CardFields& fields, int index, std::string_view name);

  Eigen::Vector3d position(int node) const { return deck.mesh.position.col(node); }
};

/// Function for CardFields::id_list(): it appends the ids of the grid points in a range.
struct KnownGrids {
  const IdTable& table;
  void operator()(long first, long last, std::vector<long>& ids) const { table.between(first, last, ids); }
};

/// Sorts the cards by name and reads PARAM. Cards that do not belong to a superelement become remarks. Unsupported
/// cards become a fault or a remark, as `options` say.
void sort_cards(const DeckOptions& options, NastranModel& model);

/// Adds the beams to the mesh. The next functions add shells, solids, springs, point masses and rods. add_rods() must
/// be called last: the torsion of rods needs nodes whose rotation other elements hold.
void add_beams(NastranModel& model);
void add_shells(NastranModel& model);
void add_solids(NastranModel& model);
void add_springs(NastranModel& model);
void add_masses(NastranModel& model);  // in springs.cpp
void add_rods(NastranModel& model);

/// Adds RBE1, RBE2, RBE3 and RBAR as spiders, and MPC as equations, to the mesh.
void add_ties(NastranModel& model);

/// Components of each node to which stiffness, mass or a tie is attached, in part axes. A node has all three rotations
/// or none.
std::vector<Components> attachments(const Mesh& mesh);

/// Makes the coordinates of ASET and BSET cards the boundary of the mesh.
void add_boundary(NastranModel& model);

/// Adds a fault for each support to ground: SPC, SPC1, PS of GRID and springs to ground. If nothing with stiffness,
/// mass or tie is attached to the component, a remark replaces the fault.
void judge_supports(NastranModel& model);

/// Removes nodes without attachments from the mesh and adds a remark about them. Sets Deck::node_of_id and the sets of
/// elements with equal PID.
void finish_nodes(NastranModel& model);

/// Reads GRID, GRDSET and coordinate systems. Sets the nodes of the mesh, the members grid_* and the frames.
void place_grids(NastranModel& model);

}  // namespace tisserand::reducer

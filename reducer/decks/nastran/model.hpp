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

/// Defaults of GRID fields.
struct GridDefaults {
  int position_frame = 0;
  int displacement_frame = 0;
  Components fixed = 0;
};

/// Components of a node that the deck holds to ground, in the axes of its CD.
struct HeldNode {
  int node = 0;
  Components components = 0;
  std::size_t card = 0;  ///< index in NastranCards::cards
};

struct NastranModel {
  NastranCards cards;
  DeckFaults faults;
  NastranRemarks remarks;                                ///< become warnings of the mesh
  std::map<std::string, std::vector<std::size_t>> rows;  ///< cards by name in capitals, in the order of the deck
  NastranFrames frames;
  IdTable grid_rows;          ///< GRID id -> row = node of the mesh
  std::vector<long> grid_id;  ///< one per node, like the next three
  std::vector<std::size_t> grid_card;
  std::vector<int> displacement_frame;                            ///< index in `frames`
  std::vector<Components> fixed;                                  ///< PS: components held to ground
  double mass_scale = 1.0;                                        ///< PARAM,WTMASS: factor of all masses
  formats::MassMatrix mass_matrix = formats::MassMatrix::lumped;  ///< PARAM,COUPMASS
  NastranMaterials materials;
  NastranProperties properties;
  std::map<long, ElementSet> of_property;                  ///< elements by PID
  std::vector<std::pair<long, std::size_t>> element_card;  ///< element id and card, to find duplicate ids
  std::vector<HeldNode> held;
  std::set<std::string> told;  ///< sets that case control does not select
  Deck deck;

  /// Calls action(CardFields&) for every card of this name.
  template <class Action>
  void for_each(const std::string& name, const Action& action) {
    const auto found = rows.find(name);
    if (found == rows.end()) return;
    for (const std::size_t row : found->second) {
      CardFields fields = card(row);
      action(fields);
    }
  }

  /// Card at an index of NastranCards::cards, and index of a card.
  CardFields card(std::size_t row) { return {cards, cards.cards[row], faults}; }
  std::size_t row(const CardFields& fields) const {
    return static_cast<std::size_t>(&fields.card() - cards.cards.data());
  }

  /// Node of the GRID in this field; −1 after a fault (no number, no such GRID).
  int node(CardFields& fields, int index, std::string_view name);

  /// Node of the GRID, or −1 with a fault.
  int node_of(CardFields& fields, long id, std::string_view name);

  /// Axes of the displacements of a node (columns, part axes): CD of its GRID.
  Eigen::Matrix3d displacement_axes(int node) const;

  /// Element id in this field, recorded to find duplicate ids.
  int element_id(CardFields& fields, int index = 0);

  /// Whether the card's set of SPC or MPC (field 0) is active. Without case control all are, otherwise those that it
  /// selects, also by SPCADD or MPCADD. A remark names the others.
  bool holds(CardFields& fields, const std::string& kind);

  /// Index in `frames` of the coordinate system in this field (blank: 0, basic); −1 after a fault.
  int frame(CardFields& fields, int index, std::string_view name);

  Eigen::Vector3d position(int node) const { return deck.mesh.position.col(node); }
};

/// Grid points whose id is in a range, for lists with THRU.
struct KnownGrids {
  const IdTable& table;
  void operator()(long first, long last, std::vector<long>& ids) const { table.between(first, last, ids); }
};

/// Sorts the cards by name; reads PARAM. Cards that do not belong to a superelement become remarks. Unsupported ones
/// become a fault or a remark.
void sort_cards(const DeckOptions& options, NastranModel& model);

/// Add elements, point masses and springs. Rods are last: their torsion needs nodes whose rotation others hold.
void add_beams(NastranModel& model);
void add_shells(NastranModel& model);
void add_solids(NastranModel& model);
void add_springs(NastranModel& model);
void add_masses(NastranModel& model);  // in springs.cpp
void add_rods(NastranModel& model);

/// Adds RBE1, RBE2, RBE3, RBAR as spiders, MPC as equations.
void add_ties(NastranModel& model);

/// Components of each node (part axes, rotations all or none) with stiffness, mass or tie attached.
std::vector<Components> attachments(const Mesh& mesh);

/// Makes ASET and BSET cards the boundary.
void add_boundary(NastranModel& model);

/// Adds a fault for SPC, SPC1, PS of GRID and springs to ground, unless nothing is attached to the component.
void judge_supports(NastranModel& model);

/// Removes nodes without attachments from the mesh (a remark), and sets node_of_id and the sets of PIDs.
void finish_nodes(NastranModel& model);

/// Reads GRID, GRDSET and coordinate systems: sets the nodes of the mesh, grid_* and frames.
void place_grids(NastranModel& model);

}  // namespace tisserand::reducer

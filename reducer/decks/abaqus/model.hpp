// SPDX-License-Identifier: GPL-3.0-or-later
// Data that read_abaqus() collects from the blocks of a deck for the mesh: nodes, elements and names by scope.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/error.hpp"
#include "reducer/decks/abaqus/element_types.hpp"
#include "reducer/decks/abaqus/lines.hpp"
#include "reducer/decks/deck.hpp"
#include "reducer/decks/faults.hpp"
#include "reducer/properties/laminate.hpp"

namespace tisserand::reducer::abaqus {

/// Position of an instance: x = R x_part + t.
struct Placement {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

/// Data of *ORIENTATION: axes in the columns, already turned with the instance, and the second data line.
struct Orientation {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  bool is_rectangular = true;
  std::optional<int> normal_axis;  ///< 0, 1, 2: axis nearest to the normal of a shell; absent: no second line
  std::string where;
};

/// Element as written. Its nodes are in Model::connectivity in the order of Abaqus.
struct RawElement {
  long id = 0;
  const ElementType* type = nullptr;
  std::size_t first = 0;  ///< index in Model::connectivity
  int count = 0;
  int section = -1;  ///< index in Model::sections
  int row = -1;      ///< index in its vector of the Mesh
  int scope = 0;
  std::uint32_t file = 0;
  std::uint32_t line = 0;
};

/// *SURFACE: faces of elements (0-5: S1-S6; -1: all faces that no other element shares; shells have the face 0 only),
/// or nodes.
struct SurfaceFace {
  int element = 0;
  int face = 0;
};
struct Surface {
  bool is_nodal = false;
  std::vector<SurfaceFace> faces;
  std::vector<int> nodes;
};

/// Meaning of ids and names: the assembly (or a flat deck) is scope 0, and every instance is another scope.
struct Scope {
  std::string name;  ///< name of the instance, "" for scope 0
  Placement placement;
  std::vector<const Block*> blocks;
  std::unordered_map<long, int> nodes;     ///< id -> column of the mesh
  std::unordered_map<long, int> elements;  ///< id -> row of Model::elements
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, std::vector<int>> element_sets;
  std::map<std::string, Surface> surfaces;
  std::map<std::string, Orientation> orientations;
};

/// Elastic constants and density; decks/abaqus/materials.hpp converts them for sections.
struct AbaqusMaterial {
  enum class Kind { none, isotropic, lamina, orthotropic };
  std::string name;
  Kind kind = Kind::none;
  double E = 0.0, nu = 0.0;                                             ///< isotropic
  Ply lamina;                                                           ///< constants only
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();  ///< orthotropic, order of SolidMaterial
  double density = 0.0;
  std::string where;
};

/// A section keyword after reading: the kind of its elements and their data.
struct SectionUse {
  ElementKind kind = ElementKind::shell;
  int property = -1;           ///< index of the property of its kind in the mesh
  int slender_property = -1;   ///< beams: likewise without shear, made when the first B33 needs it
  double offset = 0.0;         ///< shells: offset of the middle surface along the normal
  bool has_direction = false;  ///< shells: anisotropic, so that material_x is needed
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< shells: material x; zero: Abaqus' default. Beams: n1
  double mass = 0.0;                                    ///< MASS
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();    ///< ROTARYI, part axes
  double stiffness = 0.0;                               ///< springs
  std::array<int, 2> components{};                      ///< SPRING2: 0-5
  std::optional<Eigen::Matrix3d> axes;  ///< SPRING2: directions of the components; absent: those of the nodes
  std::string name;
};

struct Model {
  explicit Model(const Input& text) : input(text) {}

  const Input& input;
  DeckFaults faults{"... and {} more errors"};
  std::vector<Scope> scopes;        ///< [0]: the assembly or the flat deck
  std::vector<const Block*> steps;  ///< blocks between *STEP and *END STEP
  std::vector<Eigen::Vector3d> positions;
  std::vector<long> node_ids;
  std::vector<int> node_scopes;
  std::map<int, Eigen::Matrix3d> node_axes;  ///< *TRANSFORM: columns are the directions of the node's components
  std::map<int, std::string> undirected;     ///< nodes whose *TRANSFORM gives no directions, with the reason
  std::vector<RawElement> elements;
  std::vector<int> connectivity;
  std::map<std::string, AbaqusMaterial> materials;
  std::vector<SectionUse> sections;
  std::map<std::string, long> unknown;  ///< numbers of unsupported keywords and element types
  std::map<std::string, long> skipped;  ///< numbers of keywords without effect on S and M
  bool has_unknown_elements = false;    ///< sets may then name elements that were not read
  Deck deck;

  /// Name for messages, "node 7" or "node wing-1.7".
  std::string node_text(int node) const;
  std::string element_text(const RawElement& element) const;
  /// Nodes in the order of Abaqus.
  const int* nodes_of(const RawElement& element) const { return connectivity.data() + element.first; }

  /// File and line of a block, a data line or an element.
  std::string where(const Block& block) const { return input.where(block); }
  std::string where(const Line& line) const { return input.where(line); }
  std::string where(const RawElement& element) const { return input.where(Line{{}, element.file, element.line}); }

  /// Adds an error at a block, a line, an element or a known place.
  template <class Place>
  void fault(std::string what, const Place& place, std::string remedy) {
    if constexpr (std::is_convertible_v<Place, std::string>)
      faults.add(std::move(what), place, std::move(remedy));
    else
      faults.add(std::move(what), where(place), std::move(remedy));
  }
  /// Adds an error and returns nothing, for functions that end with it.
  template <class Place>
  std::nullopt_t refuse(std::string what, const Place& place, std::string remedy) {
    fault(std::move(what), place, std::move(remedy));
    return std::nullopt;
  }
  /// Error to be thrown.
  template <class Place>
  Error error(std::string what, const Place& place, std::string remedy) const {
    return {std::move(what), where(place), std::move(remedy)};
  }
};

/// Reads the numbers of a data line, at most values.size(); blank fields keep their value. False after a fault.
bool read_numbers(Model& model, const Block& block, const Line& line, std::span<double> values);

}  // namespace tisserand::reducer::abaqus

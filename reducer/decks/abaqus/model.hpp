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

/// Position of an instance of a part in the assembly: x = R x_part + t.
struct Placement {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

/// Directions that *ORIENTATION gives: axes in the columns, already turned with the instance, and the axis that the
/// second data line names.
struct Orientation {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  bool is_rectangular = true;
  /// 0, 1 or 2: axis nearest to the normal of a shell; absent without a second data line.
  std::optional<int> normal_axis;
  std::string where;
};

/// Element as the deck gives it. Its nodes are in Model::connectivity, in the order of Abaqus.
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

/// Face of an element that belongs to a *SURFACE. `face` is 0 to 5 for S1 to S6, or −1 for all faces that no other
/// element shares. Shells have the face 0 only.
struct SurfaceFace {
  int element = 0;
  int face = 0;
};
/// Surface of a *SURFACE: faces of elements, or nodes if `is_nodal`.
struct Surface {
  bool is_nodal = false;
  std::vector<SurfaceFace> faces;
  std::vector<int> nodes;
};

/// Name space of a deck, in which the ids and names of nodes, elements, sets, surfaces and orientations are looked up.
/// Scope 0 is the assembly, or the whole of a deck without parts. Every instance of a part is another scope.
struct Scope {
  std::string name;  ///< name of the instance; "" for scope 0
  Placement placement;
  std::vector<const Block*> blocks;
  std::unordered_map<long, int> nodes;     ///< key: id, value: column of Mesh::position
  std::unordered_map<long, int> elements;  ///< key: id, value: index in Model::elements
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, std::vector<int>> element_sets;
  std::map<std::string, Surface> surfaces;
  std::map<std::string, Orientation> orientations;
};

/// Elastic constants and density of a *MATERIAL. decks/abaqus/materials.hpp converts them for sections.
struct AbaqusMaterial {
  enum class Kind { none, isotropic, lamina, orthotropic };
  std::string name;
  Kind kind = Kind::none;
  double E = 0.0, nu = 0.0;  ///< constants of an isotropic material
  /// Constants of a lamina, without thickness and angle.
  Ply lamina;
  /// Elasticity of an orthotropic material, in the order of SolidMaterial.
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  double density = 0.0;
  std::string where;
};

/// Section keyword after reading: the kind of its elements and the data that they take from it.
struct SectionUse {
  ElementKind kind = ElementKind::shell;
  int property = -1;           ///< index of the property of its kind in the mesh
  int slender_property = -1;   ///< beams: index of the property without shear, made when the first B33 needs it
  double offset = 0.0;         ///< shells: offset of the middle surface along the normal
  bool has_direction = false;  ///< shells: anisotropic, so that material_x is needed
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< shells: material x (zero: Abaqus' default); beams: n1
  double mass = 0.0;                                    ///< mass of MASS elements
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();    ///< inertia of ROTARYI elements, part axes
  double stiffness = 0.0;                               ///< stiffness of springs
  std::array<int, 2> components{};                      ///< SPRING2: component of each node, 0 to 5
  /// SPRING2: directions of the components in columns; absent: those of the nodes.
  std::optional<Eigen::Matrix3d> axes;
  std::string name;
};

/// Contents of an Abaqus or CalculiX deck while it is converted to a mesh.
struct Model {
  explicit Model(const Input& text) : input(text) {}

  const Input& input;
  DeckFaults faults{"... and {} more errors"};
  std::vector<Scope> scopes;        ///< name spaces; scopes[0] is the assembly or a deck without parts
  std::vector<const Block*> steps;  ///< blocks between *STEP and *END STEP
  std::vector<Eigen::Vector3d> positions;
  std::vector<long> node_ids;
  std::vector<int> node_scopes;
  /// Directions of the components of a node (columns), by *TRANSFORM; key: node.
  std::map<int, Eigen::Matrix3d> node_axes;
  std::map<int, std::string> undirected;  ///< nodes whose *TRANSFORM gives no directions, with the reason
  std::vector<RawElement> elements;
  std::vector<int> connectivity;
  std::map<std::string, AbaqusMaterial> materials;
  std::vector<SectionUse> sections;
  std::map<std::string, long> unknown;  ///< number of occurrences of unsupported keywords and element types
  std::map<std::string, long> skipped;  ///< number of occurrences of keywords without effect on S and M
  bool has_unknown_elements = false;    ///< true: sets may name elements that were not read
  Deck deck;

  /// Name of a node for messages, "node 7" or "node wing-1.7".
  std::string node_text(int node) const;
  std::string element_text(const RawElement& element) const;
  /// Nodes of an element in the order of Abaqus.
  const int* nodes_of(const RawElement& element) const { return connectivity.data() + element.first; }

  /// File and line of a block, a data line or an element, for messages.
  std::string where(const Block& block) const { return input.where(block); }
  std::string where(const Line& line) const { return input.where(line); }
  std::string where(const RawElement& element) const { return input.where(Line{{}, element.file, element.line}); }

  /// Adds a fault at `place`: a block, a data line, an element, or the text of a place.
  template <class Place>
  void fault(std::string what, const Place& place, std::string remedy) {
    if constexpr (std::is_convertible_v<Place, std::string>)
      faults.add(std::move(what), place, std::move(remedy));
    else
      faults.add(std::move(what), where(place), std::move(remedy));
  }
  /// Adds a fault and returns nothing, as the return value of functions that end with this fault.
  template <class Place>
  std::nullopt_t refuse(std::string what, const Place& place, std::string remedy) {
    fault(std::move(what), place, std::move(remedy));
    return std::nullopt;
  }
  /// Error at `place`, which the caller throws.
  template <class Place>
  Error error(std::string what, const Place& place, std::string remedy) const {
    return {std::move(what), where(place), std::move(remedy)};
  }
};

/// Reads the numbers of a data line into `values`, at most values.size() of them. A blank field keeps its value.
/// Returns false after a fault.
bool read_numbers(Model& model, const Block& block, const Line& line, std::span<double> values);

}  // namespace tisserand::reducer::abaqus

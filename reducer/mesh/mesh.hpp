// SPDX-License-Identifier: GPL-3.0-or-later
// Finite element model of a part: nodes, elements, masses and ties. All input formats (part.yaml, gmsh, decks of other
// programs) produce it for assembly.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "formats/part/part.hpp"
#include "reducer/mesh/loads.hpp"
#include "reducer/properties/beam_data.hpp"
#include "reducer/properties/shell_section.hpp"
#include "reducer/properties/solid_material.hpp"

namespace tisserand::reducer {

/// Set of components of a node as bits: bits 0 to 2 for translations x, y, z, bits 3 to 5 for rotations about them.
using Components = std::uint8_t;
inline constexpr Components translations_only = 0b000111;
inline constexpr Components rotations_only = 0b111000;
inline constexpr Components all_components = 0b111111;

/// Beam of two nodes with its axes R_PE. The columns of R_PE are x, y, z of the element in part axes; x points from
/// end to end of the beam axis.
struct BeamElement {
  int first = 0;
  int second = 0;
  Eigen::Matrix3d R_PE = Eigen::Matrix3d::Identity();
  int property = 0;  ///< index in Mesh::beam_properties
  /// Vector from the first node to the first end of the beam axis, part axes.
  Eigen::Vector3d first_offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d second_offset = Eigen::Vector3d::Zero();
  std::uint16_t released = 0;  ///< bit k: the k-th of the twelve end forces (element axes) is zero
  int id = 0;                  ///< number in a deck or group, for messages
};

/// Section and material that beams share. The length of each beam comes from its ends.
struct BeamProperty {
  BeamElementData data;
  std::string name;  ///< name of the line, group or property card, for messages
};

/// Shell with three or four nodes, counter-clockwise seen against its normal. For a triangle nodes[3] is −1.
struct ShellElement {
  std::array<int, 4> nodes{-1, -1, -1, -1};
  int property = 0;     ///< index in Mesh::shell_properties
  double offset = 0.0;  ///< offset of the middle surface from the nodes, along the normal
  /// Direction in part axes whose projection is the x axis of the laminate. If it is zero, x points from nodes[0] to
  /// nodes[1].
  Eigen::Vector3d material_x = Eigen::Vector3d::Zero();
  int id = 0;
  int corners() const { return nodes[3] < 0 ? 3 : 4; }
};

/// Properties that shell elements share: stiffness of the section, mass matrix and name.
struct ShellProperty {
  ShellSection section;
  formats::MassMatrix mass_matrix = formats::MassMatrix::consistent;
  std::string name;
};

/// Shapes of solids. The order of the nodes is that of the gmsh elements 4, 11, 5, 17, 6, 18 (gmsh documentation,
/// "Node ordering").
enum class SolidShape : std::uint8_t { tetrahedron4, tetrahedron10, hexahedron8, hexahedron20, prism6, prism15 };
int node_count(SolidShape shape);

/// Solid element: shape, nodes and property.
struct SolidElement {
  SolidShape shape = SolidShape::tetrahedron4;
  std::array<int, 20> nodes{};
  int property = 0;  ///< index in Mesh::solid_properties
  int id = 0;
};

/// Nodes of a beam, shell or solid in their order.
inline std::array<int, 2> nodes_of(const BeamElement& beam) { return {beam.first, beam.second}; }
inline std::span<const int> nodes_of(const ShellElement& shell) {
  return std::span(shell.nodes).first(static_cast<std::size_t>(shell.corners()));
}
inline std::span<const int> nodes_of(const SolidElement& solid) {
  return std::span(solid.nodes).first(static_cast<std::size_t>(node_count(solid.shape)));
}

/// Properties that solid elements share: material, mass matrix and name.
struct SolidProperty {
  SolidMaterial material;
  formats::MassMatrix mass_matrix = formats::MassMatrix::consistent;
  std::string name;
};

/// Spring or bushing between two nodes, as a 12 x 12 stiffness in part axes. elements/spring.hpp makes this stiffness.
struct Spring {
  int first = 0;
  int second = 0;
  Eigen::Matrix<double, 12, 12> stiffness = Eigen::Matrix<double, 12, 12>::Zero();
  std::string name;
};

inline std::array<int, 2> nodes_of(const Spring& spring) { return {spring.first, spring.second}; }

/// Rigid mass with rotary inertia, fixed to a node with an offset.
struct NodalMass {
  int node = 0;
  double mass = 0.0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< inertia about the centre of mass, part axes
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();   ///< vector from the node to the centre of mass, part axes
  std::string name;
};

/// Kind of a spider. rigid: its nodes follow the reference node (RBE2). averaging: the reference node follows the
/// weighted mean motion of the nodes, which can still deform (RBE3).
enum class SpiderKind { rigid, averaging };

/// Connection of a reference node with other nodes, rigid or averaging.
struct Spider {
  SpiderKind kind = SpiderKind::rigid;
  int reference = 0;
  std::vector<int> nodes;
  std::vector<double> weight;  ///< averaging spider: weight of each node, positive
  /// Components of the nodes that follow (rigid) or are averaged (averaging).
  Components node_components = all_components;
  /// Averaging spider: components of the reference that the mean defines.
  Components reference_components = all_components;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: directions of the components, in part axes
  std::string name;
};

/// Term coefficient u(node, component) of a linear equation whose terms have the sum 0, in part axes (MPC, *EQUATION,
/// ties in local axes).
struct TieTerm {
  int node = 0;
  int component = 0;
  double coefficient = 0.0;
};

/// Linear equation between coordinates of the mesh: the sum of its terms is zero.
struct TieEquation {
  std::vector<TieTerm> terms;  ///< terms; the first has the coordinate that is preferably made dependent
  std::string name;
};

/// Node that other bodies see. Components that are not retained stay internal coordinates.
struct MeshBoundary {
  std::string name;
  int node = 0;
  bool translations = true;
  bool rotations = true;
};

/// Node whose held components tie the frame of a modal body to it.
struct FrameNode {
  std::string name;
  int node = 0;
  Components components = all_components;
};

/// Finite-element mesh of a part: nodes, elements, properties, connections, boundary and load cases.
struct Mesh {
  Eigen::Matrix3Xd position;            ///< 3 x nodes, part frame
  std::vector<std::string> node_label;  ///< name of each node for messages: "tip", "spar[3]" or "node 4711"
  std::vector<int> node_number;         ///< number of each node in the mesh file; 0: none; empty: no node has one
  std::vector<BeamProperty> beam_properties;
  std::vector<BeamElement> beams;
  std::vector<ShellProperty> shell_properties;
  std::vector<ShellElement> shells;
  std::vector<SolidProperty> solid_properties;
  std::vector<SolidElement> solids;
  std::vector<Spring> springs;
  std::vector<NodalMass> masses;
  std::vector<Spider> spiders;
  std::vector<TieEquation> equations;
  std::vector<MeshBoundary> boundary;
  std::vector<FrameNode> held;        ///< nodes that hold the frame of a modal body (formats::ModalBodyRequest)
  std::vector<MeshSupport> supports;  ///< supports for `reducer solve`
  std::vector<MeshLoadCase> load_cases;
  /// Warnings from reading the part, which are reported and kept in the certificate.
  std::vector<std::string> warnings;

  int nodes() const { return static_cast<int>(position.cols()); }
  int elements() const { return count_of(beams) + count_of(shells) + count_of(solids) + count_of(springs); }
};

/// Appends `row` to `rows` and returns its index.
template <class Row>
int add_row(std::vector<Row>& rows, std::type_identity_t<Row> row) {
  rows.push_back(std::move(row));
  return count_of(rows) - 1;
}

/// Normal vector of a shell, whose length is twice the area.
Eigen::Vector3d normal_of(const Mesh& mesh, const ShellElement& shell);

/// Characteristic length of a mesh, which scales rotations: the largest distance of a node from the mean of the nodes,
/// or 1 if this is 0.
double characteristic_length(const Mesh& mesh);

/// Throws Error unless elements and ties connect the mesh to one piece. The message names the pieces and the nearest
/// pair of nodes between two of them.
void check_connected(const Mesh& mesh, const std::string& where);

/// Node with the components at which it is held.
struct HeldComponents {
  int node = 0;
  Components components = all_components;
};

/// Descriptions of the rigid motions of the mesh that `held` nodes leave free, such as "turning about the axis (0, 0,
/// 1) through (0, 0, 0)". It is empty if there are none.
std::vector<std::string> free_motions(const Mesh& mesh, const std::vector<HeldComponents>& held);

/// Throws Error if the retained boundary coordinates leave a rigid motion of the part free. The message names these
/// motions.
void check_boundary_holds(const Mesh& mesh, const std::string& where);

}  // namespace tisserand::reducer

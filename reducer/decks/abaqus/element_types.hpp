// SPDX-License-Identifier: GPL-3.0-or-later
// Element types of Abaqus and CalculiX that read_abaqus() maps to the elements of a Mesh, with their faces.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer::abaqus {

/// Kinds of elements that the reader of Abaqus and CalculiX decks supports.
enum class ElementKind {
  shell,
  beam,
  truss,
  solid,
  mass,
  rotary_inertia,
  axial_spring,
  two_node_spring,
  ground_spring
};

/// Element type of an Abaqus or CalculiX deck, with its number of nodes and the element of the mesh.
struct ElementType {
  std::string_view name;
  ElementKind kind = ElementKind::shell;
  int nodes = 0;  ///< number of nodes; beams may have one more, which gives n1
  SolidShape shape = SolidShape::tetrahedron4;
  formats::BeamTheory theory = formats::BeamTheory::timoshenko;
};

/// Element type by its name in upper case; null if the reader does not support it.
const ElementType* find_element_type(const std::string& name);

/// Reason why an element type is refused that resembles a supported one, and the remedy. Both are empty for all other
/// types.
struct RefusedType {
  std::string why;
  std::string remedy;
};
RefusedType refused_type(const std::string& name);

/// Index, in the node order of Abaqus, of each node of the solid in the node order of gmsh (element library of Abaqus;
/// gmsh documentation, "Node ordering").
std::span<const int> gmsh_order(SolidShape shape);

/// Indices of the nodes of a face of a solid, in the node order of Abaqus: corners around the face, then the middle
/// nodes of the edges between them. `face`: 0 for S1 and so on. The result is empty if the element has no such face.
std::span<const int> face_nodes(SolidShape shape, int face);

/// Share of each node of a face in the area of the face. Nodes of linear faces have equal shares. Nodes of quadratic
/// faces have shares in the ratio of ∫N², which are positive: corner : middle = 1 : 16/3 for six nodes, 3 : 16 for
/// eight. CalculiX (couplings.f, 2.x) uses ∫N dA. This is equal for linear faces with parallel sides, but zero at the
/// corners of six nodes and negative for eight.
std::vector<double> face_weights(std::size_t nodes);

}  // namespace tisserand::reducer::abaqus

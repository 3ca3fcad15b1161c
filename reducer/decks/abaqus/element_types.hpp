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

struct ElementType {
  std::string_view name;
  ElementKind kind = ElementKind::shell;
  int nodes = 0;  ///< beams may have another one, which gives n1
  SolidShape shape = SolidShape::tetrahedron4;
  formats::BeamTheory theory = formats::BeamTheory::timoshenko;
};

/// Element type by its name in upper case; null if it is not supported.
const ElementType* find_element_type(const std::string& name);

/// Reason why a type that resembles a known one is refused, and the remedy; empty for all others.
struct RefusedType {
  std::string why;
  std::string remedy;
};
RefusedType refused_type(const std::string& name);

/// Place in the order of Abaqus for each node of the gmsh element (element library of Abaqus; gmsh documentation, "Node
/// ordering").
std::span<const int> gmsh_order(SolidShape shape);

/// Nodes of a face (0: S1, ...) in the order of Abaqus: corners around, then the middle nodes of the edges between
/// them. Empty if the element has no such face.
std::span<const int> face_nodes(SolidShape shape, int face);

/// Share of each node of a face in its area. Nodes of linear faces have equal shares. Quadratic ones have the ratio of
/// ∫N² (corner : middle = 1 : 16/3 for six nodes, 3 : 16 for eight), which is positive. CalculiX (couplings.f, 2.x)
/// uses ∫N dA: the same for linear faces with parallel sides, zero at corners of six nodes, negative for eight.
std::vector<double> face_weights(std::size_t nodes);

}  // namespace tisserand::reducer::abaqus

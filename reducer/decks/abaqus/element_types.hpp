// The element types of Abaqus and CalculiX that read_abaqus() maps to the elements of a Mesh, with their faces.
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
  int nodes = 0;  ///< beams may have one more, which gives n1
  SolidShape shape = SolidShape::tetrahedron4;
  formats::BeamTheory theory = formats::BeamTheory::timoshenko;
};

/// Nothing for types that are not understood. `name` in upper case.
const ElementType* find_element_type(const std::string& name);

/// Why a type that resembles a known one is refused, and what to do; empty for all others.
struct RefusedType {
  std::string why;
  std::string remedy;
};
RefusedType refused_type(const std::string& name);

/// For each node of the gmsh element its place in the order of Abaqus (element library of Abaqus; gmsh documentation,
/// "Node ordering").
std::span<const int> gmsh_order(SolidShape shape);

/// Nodes of a face (0: S1, ...) in the order of Abaqus: corners around, then the middle nodes of the edges between
/// them. Empty if the element has no such face.
std::span<const int> face_nodes(SolidShape shape, int face);

/// What each node of a face with these corners stands for, as a fraction of its area: equal parts for linear faces; for
/// quadratic ones in the ratio of ∫N² (corner : middle = 1 : 16/3 for six nodes, 3 : 16 for eight), which is positive.
/// CalculiX (couplings.f, 2.x) takes ∫N dA: the same for linear faces of parallel sides, no corners for six nodes and
/// negative ones for eight.
std::vector<double> face_weights(std::size_t nodes);

}  // namespace tisserand::reducer::abaqus

// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of element types, node orders and faces.
#include "reducer/decks/abaqus/element_types.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "reducer/elements/mesh_error.hpp"

namespace tisserand::reducer::abaqus {
namespace {

using enum ElementKind;
using formats::BeamTheory;

constexpr ElementType solid_type(std::string_view name, SolidShape shape, int nodes) {
  return {name, solid, nodes, shape, BeamTheory::timoshenko};
}
constexpr ElementType beam_type(std::string_view name, BeamTheory theory) {
  return {name, beam, 2, SolidShape::tetrahedron4, theory};
}
constexpr ElementType plain(std::string_view name, ElementKind kind, int nodes) {
  return {name, kind, nodes, SolidShape::tetrahedron4, BeamTheory::timoshenko};
}

constexpr std::array kTypes = {
    plain("S3", shell, 3),
    plain("S3R", shell, 3),
    plain("S3RS", shell, 3),
    plain("STRI3", shell, 3),
    plain("S4", shell, 4),
    plain("S4R", shell, 4),
    plain("S4RS", shell, 4),
    plain("S4R5", shell, 4),
    beam_type("B31", BeamTheory::timoshenko),
    beam_type("B31H", BeamTheory::timoshenko),
    beam_type("B31R", BeamTheory::timoshenko),
    beam_type("PIPE31", BeamTheory::timoshenko),
    beam_type("B33", BeamTheory::euler_bernoulli),
    beam_type("B33H", BeamTheory::euler_bernoulli),
    plain("T3D2", truss, 2),
    solid_type("C3D4", SolidShape::tetrahedron4, 4),
    solid_type("C3D4H", SolidShape::tetrahedron4, 4),
    solid_type("C3D6", SolidShape::prism6, 6),
    solid_type("C3D8", SolidShape::hexahedron8, 8),
    solid_type("C3D8R", SolidShape::hexahedron8, 8),
    solid_type("C3D8I", SolidShape::hexahedron8, 8),
    solid_type("C3D8H", SolidShape::hexahedron8, 8),
    solid_type("C3D10", SolidShape::tetrahedron10, 10),
    solid_type("C3D10M", SolidShape::tetrahedron10, 10),
    solid_type("C3D10HS", SolidShape::tetrahedron10, 10),
    solid_type("C3D10H", SolidShape::tetrahedron10, 10),
    solid_type("C3D10T", SolidShape::tetrahedron10, 10),
    solid_type("C3D15", SolidShape::prism15, 15),
    solid_type("C3D20", SolidShape::hexahedron20, 20),
    solid_type("C3D20R", SolidShape::hexahedron20, 20),
    solid_type("C3D20H", SolidShape::hexahedron20, 20),
    solid_type("C3D20RH", SolidShape::hexahedron20, 20),
    plain("MASS", mass, 1),
    plain("ROTARYI", rotary_inertia, 1),
    plain("SPRINGA", axial_spring, 2),
    plain("SPRING2", two_node_spring, 2),
    plain("SPRING1", ground_spring, 1),
};

constexpr std::array kTetrahedron4 = {0, 1, 2, 3};
constexpr std::array kTetrahedron10 = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::array kHexahedron8 = {0, 1, 2, 3, 4, 5, 6, 7};
constexpr std::array kHexahedron20 = {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14};
constexpr std::array kPrism6 = {0, 1, 2, 3, 4, 5};
constexpr std::array kPrism15 = {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10};

/// Corners, then middle nodes; linear elements take the first half.
struct Face {
  std::array<int, 8> nodes;
  std::size_t corners;
};
constexpr std::array kTetrahedronFaces = {Face{{0, 1, 2, 4, 5, 6}, 3}, Face{{0, 3, 1, 7, 8, 4}, 3},
                                          Face{{1, 3, 2, 8, 9, 5}, 3}, Face{{2, 3, 0, 9, 7, 6}, 3}};
constexpr std::array kHexahedronFaces = {Face{{0, 1, 2, 3, 8, 9, 10, 11}, 4},   Face{{4, 7, 6, 5, 15, 14, 13, 12}, 4},
                                         Face{{0, 4, 5, 1, 16, 12, 17, 8}, 4},  Face{{1, 5, 6, 2, 17, 13, 18, 9}, 4},
                                         Face{{2, 6, 7, 3, 18, 14, 19, 10}, 4}, Face{{3, 7, 4, 0, 19, 15, 16, 11}, 4}};
constexpr std::array kPrismFaces = {Face{{0, 1, 2, 6, 7, 8}, 3}, Face{{3, 5, 4, 11, 10, 9}, 3},
                                    Face{{0, 3, 4, 1, 12, 9, 13, 6}, 4}, Face{{1, 4, 5, 2, 13, 10, 14, 7}, 4},
                                    Face{{2, 5, 3, 0, 14, 11, 12, 8}, 4}};

}  // namespace

const ElementType* find_element_type(const std::string& name) {
  for (const ElementType& type : kTypes)
    if (type.name == name) return &type;
  return nullptr;
}

RefusedType refused_type(const std::string& name) {
  static const std::vector<std::pair<std::vector<std::string_view>, RefusedType>> refused{
      {{"S6", "S8", "S8R", "S8R5", "S9R5", "STRI65"},
       {"shells with nodes in the middle of their edges are not understood", "mesh with S3 and S4 or S4R"}},
      {{"B32", "B32R", "B32H", "PIPE32", "T3D3"},
       {"beams and trusses with three nodes are not understood", "mesh with B31, B33 or T3D2"}},
      {{"B31OS", "B31OSH", "B32OS", "B32OSH"},
       {"beams with a warping degree of freedom are not understood", "mesh with B31 or with shells"}}};
  for (const auto& [names, type] : refused)
    if (std::find(names.begin(), names.end(), name) != names.end()) return type;
  return {};
}

std::span<const int> gmsh_order(SolidShape shape) {
  static constexpr std::array<std::span<const int>, 6> orders{kTetrahedron4, kTetrahedron10, kHexahedron8,
                                                              kHexahedron20, kPrism6,        kPrism15};
  return orders[static_cast<int>(shape)];
}

std::span<const int> face_nodes(SolidShape shape, int face) {
  static constexpr std::array<std::span<const Face>, 6> of_shape{kTetrahedronFaces, kTetrahedronFaces, kHexahedronFaces,
                                                                 kHexahedronFaces,  kPrismFaces,       kPrismFaces};
  const std::span<const Face> faces = of_shape[static_cast<int>(shape)];
  if (face < 0 || static_cast<std::size_t>(face) >= faces.size()) return {};
  return std::span<const int>(faces[face].nodes).first(faces[face].corners * (is_second_order(shape) ? 2 : 1));
}

std::vector<double> face_weights(std::size_t nodes) {
  if (nodes == 6) return {1.0 / 19, 1.0 / 19, 1.0 / 19, 16.0 / 57, 16.0 / 57, 16.0 / 57};
  if (nodes == 8) {
    std::vector<double> weights(8, 16.0 / 76);
    std::fill_n(weights.begin(), 4, 3.0 / 76);
    return weights;
  }
  return std::vector<double>(nodes, 1.0 / static_cast<double>(nodes));
}

}  // namespace tisserand::reducer::abaqus

// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of solid elements for tests: blocks of any shape, distorted or mapped, and single elements.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reducer/elements/solid/shapes.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

inline constexpr std::array<SolidShape, 6> all_solid_shapes{SolidShape::tetrahedron4, SolidShape::tetrahedron10,
                                                            SolidShape::hexahedron8,  SolidShape::hexahedron20,
                                                            SolidShape::prism6,       SolidShape::prism15};

std::string solid_name(SolidShape shape);

bool is_quadratic(SolidShape shape);

/// Calls f.template operator()<shape>() with the shape as a constant.
template <class F>
auto with_shape(SolidShape shape, F&& f) {
  switch (shape) {
    case SolidShape::tetrahedron4:
      return f.template operator()<SolidShape::tetrahedron4>();
    case SolidShape::tetrahedron10:
      return f.template operator()<SolidShape::tetrahedron10>();
    case SolidShape::hexahedron8:
      return f.template operator()<SolidShape::hexahedron8>();
    case SolidShape::hexahedron20:
      return f.template operator()<SolidShape::hexahedron20>();
    case SolidShape::prism6:
      return f.template operator()<SolidShape::prism6>();
    case SolidShape::prism15:
      break;
  }
  return f.template operator()<SolidShape::prism15>();
}

/// Natural coordinates of the nodes, one per column.
Eigen::Matrix3Xd natural_nodes(SolidShape shape);

/// One element with its nodes at these positions (property 0).
Mesh one_solid(SolidShape shape, const Eigen::Matrix3Xd& position, const SolidProperty& property);

/// Corners by corner of the cells of a block: a hexahedron, two prisms along z, or six tetrahedra (Kuhn).
std::vector<std::vector<int>> cell_elements(SolidShape shape, const std::array<int, 8>& h);

struct SolidBlock {
  SolidShape shape = SolidShape::hexahedron8;
  std::array<int, 3> cells{1, 1, 1};
  Eigen::Vector3d size = Eigen::Vector3d::Ones();
  double distortion = 0.0;  ///< largest random shift of inner corners in units of a cell; edges stay straight
};

/// Corners of the block, x fastest, with the inner ones shifted.
std::vector<Eigen::Vector3d> block_corners(const SolidBlock& block);

Mesh solid_block(const SolidBlock& block, const SolidProperty& property);

}  // namespace tisserand::reducer

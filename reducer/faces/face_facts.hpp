// SPDX-License-Identifier: GPL-3.0-or-later
// Facts about a face or a group of faces: its form, the side of the solid, area and middle.
#pragma once

#include <vector>

#include "reducer/faces/surface_form.hpp"
#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// Cells of dimension 2 and their orientation: outward_signs() of them, or 0.
struct FaceCells {
  std::vector<Cell> cells;
  std::vector<int> sign;
};

/// Side on which a curved face has the solid.
enum class FaceSide {
  unknown,
  convex,  ///< solid inside, as in a shaft
  concave  ///< solid outside, as in a bore
};

struct FaceFacts {
  SurfaceForm form;  ///< the normal of a plane is outward, or that of its cells
  FaceSide side = FaceSide::unknown;
  bool is_outward = false;  ///< the normal of a plane points out of the one volume that it bounds
  double area = 0.0;        ///< of the geometry if it is known, otherwise of the cells
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
};

/// Facts from the points of `exact`, if there are any, to 1e-6 of the size of the face. Otherwise from the corners of
/// the cells to 1e-4 of it (and 1e-6 of the largest coordinate, for files that round). Then curved forms need at least
/// three different normals, and no cell may turn by more than 52 degrees (seven cells around a circle). So flat faces
/// at right angles are no cylinder. The largest component of an axis is positive, except for cones: their axis leads
/// inwards from the apex.
FaceFacts face_facts(const FaceCells& face, const std::vector<Eigen::Vector3d>& position, const EntityGeometry& exact);

}  // namespace tisserand::reducer

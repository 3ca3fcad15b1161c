// SPDX-License-Identifier: GPL-3.0-or-later
// Facts about a face or a group of faces: its form, the side of the solid, area and middle.
#pragma once

#include <vector>

#include "reducer/faces/surface_form.hpp"
#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// Cells of a face (dimension 2), and the sign of each cell by outward_signs(), or 0.
struct FaceCells {
  std::vector<Cell> cells;
  std::vector<int> sign;
};

/// Side of a curved face on which the solid lies.
enum class FaceSide {
  unknown,
  convex,  ///< solid inside, as in a shaft
  concave  ///< solid outside, as in a bore
};

/// Form, side, area and middle of a face.
struct FaceFacts {
  SurfaceForm form;  ///< form; the normal of a plane points outward, or as that of its cells if the outside is unknown
  FaceSide side = FaceSide::unknown;
  bool is_outward = false;  ///< true: the normal of a plane points out of the one volume that the face bounds
  double area = 0.0;        ///< area by the geometry if it is known, otherwise by the cells
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
};

/// Finds the form, side, area and middle of a face. If `exact` has points, the form must fit them to 1e-6 of the size
/// of the face. Otherwise it must fit the corners of the cells to 1e-4 of this size (and 1e-6 of the largest
/// coordinate, for files that round). Curved forms then need at least three different normals, and no cell may turn by
/// more than 52 degrees (seven cells around a circle). So flat faces at right angles are no cylinder. The largest
/// component of an axis is positive, except for cones: their axis points inwards from the apex.
FaceFacts face_facts(const FaceCells& face, const std::vector<Eigen::Vector3d>& position, const EntityGeometry& exact);

}  // namespace tisserand::reducer

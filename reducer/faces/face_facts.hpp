// What is told of a face or a group of faces: its form, which side of it is solid, area and middle.
#pragma once

#include <vector>

#include "reducer/faces/surface_form.hpp"
#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// Cells of dimension 2 and which way round they are: outward_signs() of them, or 0.
struct FaceCells {
  std::vector<Cell> cells;
  std::vector<int> sign;
};

/// Where the solid is, seen from a curved face.
enum class FaceSide {
  unknown,
  convex,  ///< inside, as of a shaft
  concave  ///< outside, as of a bore
};

struct FaceFacts {
  SurfaceForm form;  ///< the normal of a plane is outward, or that of its cells
  FaceSide side = FaceSide::unknown;
  bool is_outward = false;  ///< the normal of a plane points out of the one volume that it bounds
  double area = 0.0;        ///< of the geometry, else of the cells
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
};

/// By `exact`, if it has points, to 1e-6 of the size of the face; else by the corners of
/// the cells to 1e-4 of it (and 1e-6 of the largest coordinate, for files that round), where curved forms need three
/// different normals at least, and no cell that turns by more than 52 degrees (seven cells around a circle): flat faces
/// that meet at right angles are no cylinder. Axes get a positive largest component, but for cones, whose axis leaves
/// the apex.
FaceFacts face_facts(const FaceCells& face, const std::vector<Eigen::Vector3d>& position, const EntityGeometry& exact);

}  // namespace tisserand::reducer

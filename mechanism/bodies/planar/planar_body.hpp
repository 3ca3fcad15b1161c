// From a superelement body in space to a planar body: the rows of S̄, M̄ and of the other arrays that stay in the plane.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/planar/split.hpp"
#include "mechanism/bodies/superelement/constants/body.hpp"

namespace tisserand::mechanism {

/// axes: of the plane in the part frame, z normal. Boundary rows: per node [x y, θ_z]; internal modes that do not
/// couple with them are left out, those of one frequency turned apart before. Entries that couple motion in the plane
/// with motion out of it up to 1e-10 of the diagonals (of the largest entry, for arrays of second order) count as zero;
/// larger ones throw LeavesPlane.
SuperelementBody planar_body(const SuperelementBody& body, const Eigen::Matrix3d& axes);

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Planar body from a superelement body in space: the rows of S̄, M̄ and of the other arrays that stay in the plane.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/planar/split.hpp"
#include "mechanism/bodies/superelement/constants/body.hpp"

namespace tisserand::mechanism {

/// Planar body in the plane with `axes` in the part frame, z normal. Boundary rows: per node [x y, θ_z]. Internal modes
/// that do not couple with them are omitted, after modes of one frequency were separated. Couplings between motions in
/// and out of the plane count as zero up to 1e-10 of the diagonals (of the largest entry, for arrays of second order).
/// Larger ones throw LeavesPlane.
SuperelementBody planar_body(const SuperelementBody& body, const Eigen::Matrix3d& axes);

}  // namespace tisserand::mechanism

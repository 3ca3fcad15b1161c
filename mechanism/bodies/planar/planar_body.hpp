// SPDX-License-Identifier: GPL-3.0-or-later
// Planar body from a superelement body in space: the rows of S̄, M̄ and of the other arrays that stay in the plane.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/planar/split.hpp"
#include "mechanism/bodies/superelement/constants/body.hpp"

namespace tisserand::mechanism {

/// Planar body from a superelement body in space. `axes` are those of the plane in the part frame, z normal to it. A
/// node has the boundary rows [x y, θ_z]. Internal modes that do not couple with these rows are omitted, after modes of
/// one frequency were separated. Couplings between motions in the plane and out of it count as zero up to 1e-10 of the
/// diagonals. For arrays of second order the limit is 1e-10 of the largest entry. Throws LeavesPlane for larger
/// couplings.
SuperelementBody planar_body(const SuperelementBody& body, const Eigen::Matrix3d& axes);

}  // namespace tisserand::mechanism

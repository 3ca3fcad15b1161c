// SPDX-License-Identifier: GPL-3.0-or-later
// Planar modal body from a modal body in space.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/modal/node.hpp"
#include "mechanism/bodies/planar/split.hpp"

namespace tisserand::mechanism {

/// Transforms the sums of the body and its nodes to the `axes` of the plane, given in its frame, z normal. Keeps the
/// modes that move in the plane, after modes of one frequency were separated. Nodes closer than 1e-10 `reach` to the
/// plane through the centre of mass lie in it. Couplings between motions in and out of the plane up to 1e-10, in units
/// of the mass of a mode, count as zero. Larger ones throw LeavesPlane. Nodes off the plane keep their motion out of
/// it, so that nothing may be attached to them.
void make_planar(const Eigen::Matrix3d& axes, double reach, ModalBody& body, const std::vector<ModalNode*>& nodes);

}  // namespace tisserand::mechanism

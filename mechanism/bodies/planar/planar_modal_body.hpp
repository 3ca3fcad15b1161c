// SPDX-License-Identifier: GPL-3.0-or-later
// Planar modal body from a modal body in space.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/modal/node.hpp"
#include "mechanism/bodies/planar/split.hpp"

namespace tisserand::mechanism {

/// Makes a modal body planar: transforms its sums and its `nodes` to `axes` of the plane (in the frame of the body, z
/// normal). Keeps the modes that move in the plane, after modes of one frequency were separated. Nodes closer than
/// 1e-10 · `reach` (a length) to the plane through the centre of mass count as nodes in the plane. Nodes off the plane
/// keep their motion out of it, so the caller must attach nothing to them. Couplings between motions in the plane and
/// out of it count as zero up to 1e-10, in units of the mass of a mode. Throws LeavesPlane for larger couplings.
void make_planar(const Eigen::Matrix3d& axes, double reach, ModalBody& body, const std::vector<ModalNode*>& nodes);

}  // namespace tisserand::mechanism

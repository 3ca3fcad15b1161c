// From a modal body in space to the one that moves in a plane.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/modal/node.hpp"
#include "mechanism/bodies/planar/split.hpp"

namespace tisserand::mechanism {

/// Turns the sums of the body and its nodes into the axes of the plane, which are given in its frame, z normal, and
/// leaves the modes that move in it, those of one frequency turned apart before. `reach`: places that are nearer to the
/// plane through the centre of mass than 1e-10 of it lie in it. Couplings of motion in the plane with motion out of it
/// up to 1e-10, in units of the mass of a mode, count as zero; larger ones throw LeavesPlane. Nodes off the plane keep
/// their motion out of it: nothing may be attached to them.
void make_planar(const Eigen::Matrix3d& axes, double reach, ModalBody& body, const std::vector<ModalNode*>& nodes);

}  // namespace tisserand::mechanism

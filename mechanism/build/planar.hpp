// SPDX-License-Identifier: GPL-3.0-or-later
// Planar model from a model in space (`effects: {planar: on}`), if nothing in it can leave the plane.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/build/bodies.hpp"

namespace tisserand::mechanism {

/// Makes the model planar: finds the plane, rotates the model to its axes, and removes all coordinates out of the
/// plane. Only coordinates, equations of joints, superelements and modes in the plane remain. Throws Error that names
/// the first body, joint, load or velocity that could leave the plane, with the quantity, its value and a remedy.
/// `initial`: coordinates with given start values. Requires that all else was built, and that coordinates were not
/// numbered yet.
void make_planar(const std::vector<CoordinateStart>& initial, Construction& c);

// Declarations of plane.cpp.

/// Unit normal of the plane of a scene in world axes, with positive largest component. It is the axis of the first
/// joint that turns about one axis or keeps a plane. Without such a joint it is the direction of the first angular
/// velocity. Without both it is normal to gravity and to the plane of the nodes.
Eigen::Vector3d find_normal(const Construction& c);

/// Right-handed axes (columns) with the unit vector `z` as the third one. If `z` is one of the old axes up to
/// round-off, the result is an exact permutation of them.
Eigen::Matrix3d axes_with_z(const Eigen::Vector3d& z);

/// Rotates all that is built to Model::axes = axes_with_z(normal). Nodes and superelements get axes of their own, whose
/// z is the normal at the start. Bodies do not change. Returns the axes of each node. Requires that coordinates were
/// not numbered yet.
std::vector<Eigen::Matrix3d> turn_into_plane(const Eigen::Vector3d& normal, Construction& c);

}  // namespace tisserand::mechanism

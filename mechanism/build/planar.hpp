// SPDX-License-Identifier: GPL-3.0-or-later
// Planar model from a model in space (`effects: {planar: on}`), if nothing in it can leave the plane.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/build/bodies.hpp"

namespace tisserand::mechanism {

/// Finds the plane, rotates the model to its axes (build/plane.hpp), and keeps only coordinates, equations of joints,
/// superelements and modes in the plane. Throws Error that names the first body, joint, load or velocity that could
/// leave it, with the quantity, its value and a remedy. `initial` holds the coordinates with given start values. Runs
/// after all else is built, before the coordinates are numbered.
void make_planar(const std::vector<CoordinateStart>& initial, Construction& c);

// Declarations of plane.cpp.

/// Unit normal in world axes, largest component positive. It is the axis of the first joint that turns about one axis
/// or keeps a plane. Otherwise it is that of the first angular velocity, else normal to gravity and the nodes.
Eigen::Vector3d find_normal(const Construction& c);

/// Right-handed axes (columns) with the unit vector `z` as third. If `z` is one of the old axes up to round-off, the
/// result is an exact permutation of them.
Eigen::Matrix3d axes_with_z(const Eigen::Vector3d& z);

/// Rotates all that is built to Model::axes = axes_with_z(normal), and nodes and superelements to axes of their own
/// with z normal at the start. Runs before the coordinates are numbered. Bodies do not change; the result holds the
/// axes of each node.
std::vector<Eigen::Matrix3d> turn_into_plane(const Eigen::Vector3d& normal, Construction& c);

}  // namespace tisserand::mechanism

// From a model in space to the planar one (`effects: {planar: on}`), if nothing in it can leave the plane.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/build/bodies.hpp"

namespace tisserand::mechanism {

/// Finds the plane, turns the model into its axes (build/plane.hpp), and leaves of coordinates, equations of joints,
/// superelements and modes those in the plane. Throws Error that names the first body, joint, load or velocity that
/// could leave it, with the quantity, its value and a remedy; `initial` are the coordinates that start as the scene
/// says. After all else is built, before the coordinates are numbered.
void make_planar(const std::vector<CoordinateStart>& initial, Construction& c);

// Of plane.cpp.

/// Unit normal in world axes, its largest component positive: the axis of the first joint that turns about one axis or
/// keeps a plane; without such a joint that of the first angular velocity; else across gravity and the nodes.
Eigen::Vector3d find_normal(const Construction& c);

/// Right-handed axes (columns) with the unit vector `z` as third: a permutation of the old ones, exactly, where it is
/// one of them but for round-off.
Eigen::Matrix3d axes_with_z(const Eigen::Vector3d& z);

/// Turns all that is built into Model::axes = axes_with_z(normal), and nodes and superelements into own axes whose z is
/// the normal at the start. Before the coordinates are numbered; bodies stay as they are, with the axes of each node in
/// the result.
std::vector<Eigen::Matrix3d> turn_into_plane(const Eigen::Vector3d& normal, Construction& c);

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Marker: a place and an orientation carried by a node (or by ground), which is all that joints and loads see of a
// body.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Pose of a marker relative to the node that carries it: origin p in axes of the node, axes R = R_NM. `node` −1 is the
/// ground; then p and R are in the world frame.
struct Marker {
  int node = -1;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  int follower = -1;  ///< index in Model::ties of the virtual body it is on, −1: none
};

/// Pose on a carrier of the marker `inner` of a body, which is placed as `outer` on this carrier.
inline Marker composed(const Marker& outer, const Marker& inner) {
  return {outer.node, outer.p + outer.R * inner.p, outer.R * inner.R, outer.follower};
}

/// World position of the origin of a marker. `carrier`: motion of its node.
inline Eigen::Vector3d marker_position(const Marker& marker, const NodeMotion& carrier) {
  return carrier.x + carrier.R * marker.p;
}

/// World velocity of the origin of a marker. `carrier`: motion of its node.
inline Eigen::Vector3d marker_velocity(const Marker& marker, const NodeMotion& carrier) {
  return carrier.xd + carrier.R * carrier.Omega.cross(marker.p);
}

/// Components x and y of R v. Requires that R is a rotation about z or that v has z = 0.
inline Eigen::Vector2d in_plane(const Eigen::Matrix3d& R, const Eigen::Vector3d& v) {
  return {R(0, 0) * v.x() + R(0, 1) * v.y(), R(1, 0) * v.x() + R(1, 1) * v.y()};
}

/// Rotation R_WM from axes of the marker to world axes. `carrier`: motion of its node.
inline Eigen::Matrix3d marker_rotation(const Marker& marker, const NodeMotion& carrier) { return carrier.R * marker.R; }

}  // namespace tisserand::mechanism

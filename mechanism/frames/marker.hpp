// SPDX-License-Identifier: GPL-3.0-or-later
// Marker: a place and an orientation carried by a node (or by ground), which is all that joints and loads see of a
// body.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Pose relative to the carrier node: p in node axes, R = R_NM. node = -1: ground, then p and R are in the world frame.
struct Marker {
  int node = -1;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  int follower = -1;  ///< eliminated virtual body that the marker is on (a row of Model::ties), −1: none
};

/// `inner`, a pose on a body that is placed as `outer` on its carrier, as a pose on that carrier.
inline Marker composed(const Marker& outer, const Marker& inner) {
  return {outer.node, outer.p + outer.R * inner.p, outer.R * inner.R, outer.follower};
}

/// World position of the marker's origin.
inline Eigen::Vector3d marker_position(const Marker& marker, const NodeMotion& carrier) {
  return carrier.x + carrier.R * marker.p;
}

/// World velocity of the marker's origin.
inline Eigen::Vector3d marker_velocity(const Marker& marker, const NodeMotion& carrier) {
  return carrier.xd + carrier.R * carrier.Omega.cross(marker.p);
}

/// x-y components of R v, of a rotation about z or of a vector with z zero.
inline Eigen::Vector2d in_plane(const Eigen::Matrix3d& R, const Eigen::Vector3d& v) {
  return {R(0, 0) * v.x() + R(0, 1) * v.y(), R(1, 0) * v.x() + R(1, 1) * v.y()};
}

/// R_WM.
inline Eigen::Matrix3d marker_rotation(const Marker& marker, const NodeMotion& carrier) { return carrier.R * marker.R; }

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Springs and bushings between two nodes: 12 x 12 stiffness of a mesh's Spring from constants, axes and places.
//
// Coordinates [u θ] of the first node, then of the second, in part axes.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace tisserand::reducer {

/// Component of a node that a spring joins: 0 to 2 for translations, 3 to 5 for rotations, along the columns of R_PA.
/// The columns of R_PA are axes A in part axes.
struct SpringEnd {
  int component = 0;
  Eigen::Matrix3d R_PA = Eigen::Matrix3d::Identity();
};

/// Stiffness matrix of a spring with the energy k (q_second − q_first)² / 2 between one component q of each node. A
/// rigid rotation of both nodes strains such a spring in general. It does not if the nodes coincide, or if the
/// component is a translation along the line between them (see rigid_motion_defect()).
Eigen::Matrix<double, 12, 12> scalar_spring(double stiffness, const SpringEnd& first, const SpringEnd& second);

/// Stiffness matrix of a spring with the energy k e² / 2 along the line between two nodes. e = (u_second − u_first)·n,
/// with n the direction from the first to the second node. Rigid motions cause no force. Returns nothing if the nodes
/// coincide.
std::optional<Eigen::Matrix<double, 12, 12>> axial_spring(double stiffness, const Eigen::Vector3d& first_to_second);

/// Place of a bushing: rigid arms to it from both nodes (part axes), and the axes R_PB of its stiffness.
struct BushingPlace {
  Eigen::Vector3d first_arm = Eigen::Vector3d::Zero();   ///< arm from the first node to the bushing
  Eigen::Vector3d second_arm = Eigen::Vector3d::Zero();  ///< arm from the second node to the bushing
  Eigen::Matrix3d R_PB = Eigen::Matrix3d::Identity();
};

/// Stiffness matrix of a bushing with the energy dᵀ K_B d / 2. d is [relative displacement; relative rotation] of its
/// second end minus its first, in axes B of `place`. Requires a symmetric `K_B`, which may couple all components.
/// Rigid motions cause no force if both arms end at the same point.
Eigen::Matrix<double, 12, 12> bushing(const Eigen::Matrix<double, 6, 6>& K_B, const BushingPlace& place);

/// Largest entry of |K R| over the largest of |K|, with the six rigid motions R of two nodes at this distance.
/// Rotations are about the middle of the nodes, and lengths in units of the distance (1 if it is 0), so the ratio has
/// no unit. About 0: the spring lets the part float. About 1: it holds the part against the ground, which a
/// superelement must not contain.
double rigid_motion_defect(const Eigen::Matrix<double, 12, 12>& K, const Eigen::Vector3d& first_to_second);

}  // namespace tisserand::reducer

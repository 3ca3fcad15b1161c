// SPDX-License-Identifier: GPL-3.0-or-later
// Springs and bushings between two nodes: 12 x 12 stiffness of a mesh's Spring from constants, axes and places.
//
// Coordinates [u θ] of the first node, then of the second, in part axes.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace tisserand::reducer {

/// Component (0-2 translations, 3-5 rotations) of a node in axes R_PA (columns: these axes in part axes).
struct SpringEnd {
  int component = 0;
  Eigen::Matrix3d R_PA = Eigen::Matrix3d::Identity();
};

/// Spring k (q_second − q_first)² / 2 between one component of each node. A rigid rotation of both nodes strains it
/// unless they coincide or the component is a translation along the line between them: see rigid_motion_defect.
Eigen::Matrix<double, 12, 12> scalar_spring(double stiffness, const SpringEnd& first, const SpringEnd& second);

/// Spring k e² / 2 with e = (u_second − u_first)·n, n the direction from the first to the second node. Rigid motions
/// are exact. Empty if the nodes coincide.
std::optional<Eigen::Matrix<double, 12, 12>> axial_spring(double stiffness, const Eigen::Vector3d& first_to_second);

/// Place of a bushing: rigid arms from both nodes (part axes) and axes R_PB of its stiffness.
struct BushingPlace {
  Eigen::Vector3d first_arm = Eigen::Vector3d::Zero();   ///< from the first node to the bushing
  Eigen::Vector3d second_arm = Eigen::Vector3d::Zero();  ///< from the second node to the bushing
  Eigen::Matrix3d R_PB = Eigen::Matrix3d::Identity();
};

/// Bushing dᵀ K d / 2 with d = [relative displacement; relative rotation], second minus first, in axes B. K is 6 x 6,
/// symmetric, and may have couplings. Rigid motions are exact if both arms end at the same point.
Eigen::Matrix<double, 12, 12> bushing(const Eigen::Matrix<double, 6, 6>& K_B, const BushingPlace& place);

/// Ratio max |K R| / max |K| with R the six rigid motions of two nodes at this distance, rotations about their middle.
/// Lengths are in units of the distance (1 if it is 0), so the number has no unit. About 0 (round-off): the spring lets
/// the part float. About 1: it holds the part against the ground, which a superelement must not contain.
double rigid_motion_defect(const Eigen::Matrix<double, 12, 12>& K, const Eigen::Vector3d& first_to_second);

}  // namespace tisserand::reducer

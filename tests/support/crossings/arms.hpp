// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of the cells.
#pragma once

#include <Eigen/Geometry>

#include "tests/support/crossings/ingredients.hpp"

namespace tisserand::test_support::crossings {

/// The pose of the arm at the start.
Eigen::Quaterniond arm_orientation();

/// Adds the arm, without velocities.
void add_arm(Arm arm, formats::Scene& scene);

/// Tip in the part frame of the arm.
Eigen::Vector3d tip_in_part(Arm arm);

/// A symmetric matrix of these principal values in axes that are none of the part.
Eigen::Matrix3d turned_inertia(const Eigen::Vector3d& principal);

}  // namespace tisserand::test_support::crossings

// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of beams, masses and directions that parts and scenes share.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Straight line or arc to check.
struct LineToCheck {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  std::optional<Eigen::Vector3d> through;
  std::optional<Eigen::Vector3d> orientation;
};

/// Checks for zero length, arc points that coincide or lie on a line, and an orientation of zero length or parallel to
/// the axis of a straight line. Ignores not-a-number.
void check_line(const LineToCheck& line, const Subject& subject);

enum class MassSign { positive, zero_allowed };

/// Checks the sign of the mass, and that inertia is finite, symmetric and positive semidefinite. No principal moment
/// may exceed the sum of the others by more than 1e-3 of it, which four digits of a flat body can cause.
void check_mass(double mass, const Eigen::Matrix3d& inertia, MassSign sign, const Subject& subject);

/// Warning that a principal moment exceeds the sum of the others beyond round-off, which is impossible for a body; or
/// empty.
std::string inertia_doubt(const std::string& subject, const Eigen::Matrix3d& inertia);

}  // namespace tisserand::formats

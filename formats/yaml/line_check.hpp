// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of beams, masses and directions that parts and scenes share.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Straight line or arc (with `through`) of a beam, as input of check_line().
struct LineToCheck {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  std::optional<Eigen::Vector3d> through;
  std::optional<Eigen::Vector3d> orientation;
};

/// Checks a line. Faults are: zero length; points of an arc that coincide or lie on a line; an orientation of zero
/// length, or parallel to the axis of a straight line. Coordinates that are NaN are ignored.
void check_line(const LineToCheck& line, const Subject& subject);

enum class MassSign { positive, zero_allowed };

/// Checks the sign of the mass, and that the inertia tensor is finite, symmetric and positive semidefinite. A principal
/// moment may exceed the sum of the other two by at most 1e-3 of its own value, which four digits of a flat body's
/// inertia can cause.
void check_mass(double mass, const Eigen::Matrix3d& inertia, MassSign sign, const Subject& subject);

/// Warning that a principal moment exceeds the sum of the other two beyond round-off, which no body can have. Empty if
/// none does.
std::string inertia_doubt(const std::string& subject, const Eigen::Matrix3d& inertia);

}  // namespace tisserand::formats

// Findings that beams, masses and directions have in common in parts and scenes.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// A straight line or an arc.
struct LineToCheck {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  std::optional<Eigen::Vector3d> through;
  std::optional<Eigen::Vector3d> orientation;
};

/// Zero length; arc points that coincide or lie on a line; orientation of zero length or, for a straight line, parallel
/// to the axis. Silent about values that are not numbers.
void check_line(const LineToCheck& line, const Subject& subject);

enum class MassSign { positive, zero_allowed };

/// Sign of the mass; inertia finite, symmetric, positive semidefinite, and no principal moment above the sum of the
/// others by more than 1e-3 of it: four typed digits of a flat body do that.
void check_mass(double mass, const Eigen::Matrix3d& inertia, MassSign sign, const Subject& subject);

/// A sentence where a principal moment exceeds the sum of the others beyond round-off, which no body's does; else
/// empty.
std::string inertia_doubt(const std::string& subject, const Eigen::Matrix3d& inertia);

}  // namespace tisserand::formats

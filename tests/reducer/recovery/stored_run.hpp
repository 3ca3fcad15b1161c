// SPDX-License-Identifier: GPL-3.0-or-later
// Results files with superelements that move as a test prescribes.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/units.hpp"

namespace tisserand::testing {

/// Results with superelements of the same coordinates, all frames at `position` turned by `rotation`.
struct StoredRun {
  std::vector<std::string> bodies{"arm"};
  std::vector<std::string> ids;
  std::vector<Eigen::VectorXd> y;  ///< per instant and body, in turn
  Units units = Units::si();
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), origin = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// One instant every 0.1 time units.
void write(const StoredRun& run, const std::string& path);

}  // namespace tisserand::testing

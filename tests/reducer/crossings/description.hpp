// SPDX-License-Identifier: GPL-3.0-or-later
// The same part written in another way: turned, mirrored, in other units, far away, with other numbers, for another
// program.
#pragma once

#include <string>

#include <Eigen/Core>

#include "tests/reducer/crossings/model.hpp"

namespace tisserand::testing::crossings {

/// x' = length (Q x + shift); masses in units of `mass` kg, seconds stay.
struct Description {
  Eigen::Matrix3d Q = Eigen::Matrix3d::Identity();  ///< orthogonal
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< m
  double length = 1.0;                              ///< units of length in a metre
  double mass = 1.0;                                ///< units of mass in a kilogram
  bool renumbered = false;
  bool is_abaqus = false;

  double handedness() const { return Q.determinant(); }
  Eigen::Vector3d place(const Eigen::Vector3d& x) const { return length * (Q * x + shift); }
  double force() const { return mass * length; }
  double stress() const { return mass / length; }
  int number(int index) const { return renumbered ? (index * 37 + 11) % 1009 + 1 : index + 1; }
};
Description description_of(Change change);

/// The deck, and the part file that reads it: its boundary is called p0, p1, ..., its loaded node `load`.
std::string deck_text(const PartModel& model, const Description& d);
std::string part_text(const PartModel& model, const Description& d, Way way, const std::string& deck);

}  // namespace tisserand::testing::crossings

// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of joints that a suite of tests runs over, so that a new row of the table is tested without further ado.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"

namespace tisserand::test_support {

inline std::vector<formats::JointKind> every_joint() {
  std::vector<formats::JointKind> kinds;
  for (const formats::JointKindRow& row : formats::joint_kinds()) kinds.push_back(row.kind);
  return kinds;
}

inline std::vector<formats::JointKind> every_joint_with_friction() {
  std::vector<formats::JointKind> kinds;
  for (const formats::JointKindRow& row : formats::joint_kinds())
    if (row.friction.has_friction) kinds.push_back(row.kind);
  return kinds;
}

inline std::string joint_test_name(const ::testing::TestParamInfo<formats::JointKind>& kind) {
  return formats::joint_word(kind.param);
}

/// Gives the joint the key that its kind takes. What is held: x, z, rx, rz. Of a distance the markers move apart, that
/// on the body `first` to one place and that on the other to another.
inline void give_own_key(formats::JointSpec& spec, const std::string& first) {
  switch (formats::joint_kind(spec.kind).key) {
    case formats::JointKey::none:
      break;
    case formats::JointKey::hold:
      spec.hold = {true, false, true, true, false, true};
      break;
    case formats::JointKey::pitch:
      spec.pitch = 0.2;
      break;
    case formats::JointKey::length:
      spec.position.reset();
      spec.axis.reset();
      (spec.a.node == first ? spec.a : spec.b).position = Eigen::Vector3d(0.5, 0.2, -0.3);
      (spec.a.node == first ? spec.b : spec.a).position = Eigen::Vector3d(-0.3, 0.6, 0.1);
      break;
  }
}

}  // namespace tisserand::test_support

// SPDX-License-Identifier: GPL-3.0-or-later
// Random mechanisms, trees and loops, by mechanism and by Simbody: a table of the largest differences.
//   compare_simbody [count]
#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/joints/joint_kinds.hpp"
#include "tests/comparison/simbody.hpp"

namespace tisserand::comparison {
namespace {

using formats::JointKind;

// Simbody has no joint of constant velocity, and none that holds what the generic one here does; its screw is a joint
// of trees alone.
const std::vector<JointKind> kinds{JointKind::fixed,          JointKind::revolute,    JointKind::spherical,
                                   JointKind::universal,      JointKind::cylindrical, JointKind::screw,
                                   JointKind::prismatic,      JointKind::planar,      JointKind::point_on_line,
                                   JointKind::point_on_plane, JointKind::distance,    JointKind::constant_orientation,
                                   JointKind::parallel_axes};
const std::vector<JointKind> closing{JointKind::fixed,
                                     JointKind::revolute,
                                     JointKind::spherical,
                                     JointKind::universal,
                                     JointKind::cylindrical,
                                     JointKind::prismatic,
                                     JointKind::planar,
                                     JointKind::point_on_line,
                                     JointKind::point_on_plane,
                                     JointKind::distance,
                                     JointKind::constant_orientation,
                                     JointKind::parallel_axes};

/// The worst mechanism of those with or without loops.
struct Worst {
  int count = 0;
  test_support::Differences largest;
  unsigned seed = 0;
};

void note(unsigned seed, const test_support::Differences& d, Worst& worst) {
  const auto size = [](const test_support::Differences& x) {
    return std::max({x.accelerations, x.reactions, x.others});
  };
  ++worst.count;
  if (size(d) >= size(worst.largest)) worst.seed = seed;
  worst.largest = {std::max(d.accelerations, worst.largest.accelerations),
                   std::max(d.reactions, worst.largest.reactions), std::max(d.others, worst.largest.others)};
}

int compare_all(unsigned count) {
  constexpr double accepted = 1e-11;
  Worst trees, loops;
  for (unsigned seed = 0; seed < count; ++seed) {
    const test_support::RandomMechanism m = test_support::random_mechanism(seed, kinds, closing);
    const test_support::Differences d = test_support::compare(start_by_simbody(m), test_support::start_of_motion(m));
    const bool has_loop = std::ranges::any_of(m.joints, &test_support::RandomJoint::closes_loop);
    note(seed, d, has_loop ? loops : trees);
  }
  fmt::print("{:<8}{:>12}{:>16}{:>12}{:>28}{:>14}\n", "", "mechanisms", "accelerations", "reactions",
             "springs, gears, drives", "worst seed");
  bool good = true;
  for (const auto& [name, worst] : {std::pair{"trees", trees}, std::pair{"loops", loops}}) {
    const test_support::Differences& d = worst.largest;
    fmt::print("{:<8}{:>12}{:>16.1e}{:>12.1e}{:>28.1e}{:>14}\n", name, worst.count, d.accelerations, d.reactions,
               d.others, worst.seed);
    good = good && std::max({d.accelerations, d.reactions, d.others}) < accepted;
  }
  fmt::print("{}: largest differences relative to the largest value of a mechanism, at most {:g} expected\n",
             good ? "agreed" : "DIFFERENT", accepted);
  return good ? 0 : 1;
}

}  // namespace
}  // namespace tisserand::comparison

int main(int count, char** words) {
  return tisserand::comparison::compare_all(count > 1 ? static_cast<unsigned>(std::atoi(words[1])) : 230u);
}

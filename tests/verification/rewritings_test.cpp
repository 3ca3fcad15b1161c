// SPDX-License-Identifier: GPL-3.0-or-later
// Descriptions of one mechanism that must give one motion: order, sides, units, pose, bodies in parts. Random trees and
// loops of all joints; accelerations and reactions at the start, which depend on all equations.
#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/scenes/joint_kinds.hpp"
#include "tests/support/scenes/random_mechanism.hpp"

namespace tisserand::mechanism::rewritings_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using formats::JointKind;
using namespace test_support;

constexpr unsigned mechanisms = 40;

/// A mechanism in another description, and what its start means for that which it describes.
struct Rewriting {
  RandomMechanism mechanism;
  std::vector<int> body, joint;                 ///< of the original: where it stands now
  std::vector<bool> swapped;                    ///< joints of the original whose sides are exchanged
  double length = 1.0, mass = 1.0, time = 1.0;  ///< of the units: numbers now over numbers then
  Frame world;                                  ///< of the original world in the new one

  explicit Rewriting(const RandomMechanism& before)
      : mechanism(before), body(before.bodies.size()), joint(before.joints.size()), swapped(before.joints.size()) {
    std::iota(body.begin(), body.end(), 0);
    std::iota(joint.begin(), joint.end(), 0);
  }
};

Vector3d origin_of(const RandomMechanism& m, int body, const Frame& frame) {
  return body < 0 ? frame.p : (m.bodies[body].pose * frame).p;
}

StartOfMotion original(const Rewriting& r, const RandomMechanism& before, const StartOfMotion& start) {
  const double acceleration = r.length / (r.time * r.time), force = r.mass * acceleration, moment = force * r.length;
  const Matrix3d back = r.world.R.transpose();
  const auto along = [&](int joint) { return before.joints[joint].along ? force : moment; };
  StartOfMotion result;
  for (std::size_t i = 0; i < before.bodies.size(); ++i) {
    const Motion& body = start.bodies[r.body[i]];
    result.bodies.push_back(
        {back * body.acceleration / acceleration, back * body.angular_acceleration * (r.time * r.time)});
  }
  for (std::size_t i = 0; i < before.joints.size(); ++i) {
    const RandomJoint& joint = before.joints[i];
    Wrench wrench = start.joints[r.joint[i]];
    wrench = {back * wrench.force / force, back * wrench.moment / moment};
    if (r.swapped[i]) {  // on the former a, about its origin
      const Vector3d arm = origin_of(before, joint.a, joint.in_a) - origin_of(before, joint.b, joint.in_b);
      wrench = {-wrench.force, -wrench.moment - arm.cross(wrench.force)};
    }
    result.joints.push_back(wrench);
  }
  for (const double value : start.springs) result.springs.push_back(value / force);
  const auto sign = [&](int joint) { return r.swapped[joint] ? -1.0 : 1.0; };
  for (std::size_t i = 0; i < start.gears.size(); ++i) {
    const int first = before.gears[i].first, second = before.gears[i].second;
    result.gears.push_back(
        {sign(first) * start.gears[i][0] / along(first), sign(second) * start.gears[i][1] / along(second)});
  }
  for (std::size_t i = 0; i < start.drives.size(); ++i) {
    const int joint = before.drives[i].joint;
    result.drives.push_back(sign(joint) * start.drives[i] / along(joint));
  }
  return result;
}

std::vector<int> shuffled(std::size_t count, std::mt19937& random) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  return order;
}

/// Bodies and joints in another order.
Rewriting other_order(const RandomMechanism& before, unsigned seed) {
  std::mt19937 random(seed);
  Rewriting r(before);
  r.body = shuffled(before.bodies.size(), random);
  r.joint = shuffled(before.joints.size(), random);
  const auto place = [&](int body) { return body < 0 ? body : r.body[body]; };
  for (std::size_t i = 0; i < before.bodies.size(); ++i) r.mechanism.bodies[r.body[i]] = before.bodies[i];
  for (std::size_t i = 0; i < before.joints.size(); ++i) {
    RandomJoint& joint = r.mechanism.joints[r.joint[i]] = before.joints[i];
    joint.a = place(joint.a);
    joint.b = place(joint.b);
  }
  for (RandomSpring& spring : r.mechanism.springs) {
    spring.a = place(spring.a);
    spring.b = place(spring.b);
  }
  for (RandomGear& gear : r.mechanism.gears) {
    gear.first = r.joint[gear.first];
    gear.second = r.joint[gear.second];
  }
  for (RandomDrive& drive : r.mechanism.drives) drive.joint = r.joint[drive.joint];
  return r;
}

/// Whether a and b mean the same to the joint: the plane and the line are those of a, the axes of `hold` too.
bool has_equal_sides(JointKind kind) {
  return kind != JointKind::point_on_line && kind != JointKind::point_on_plane && kind != JointKind::generic;
}

/// Sides exchanged; the pins of a universal joint, x of a and y of b, with them.
Rewriting other_sides(const RandomMechanism& before) {
  Rewriting r(before);
  const Frame quarter{Vector3d::Zero(), Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()).toRotationMatrix()};
  for (std::size_t i = 0; i < before.joints.size(); ++i) {
    RandomJoint& joint = r.mechanism.joints[i];
    if (!has_equal_sides(joint.kind)) continue;
    r.swapped[i] = true;
    std::swap(joint.a, joint.b);
    std::swap(joint.in_a, joint.in_b);
    joint.value = -joint.value;
    joint.rate = -joint.rate;
    if (joint.kind != JointKind::universal) continue;
    joint.in_a = joint.in_a * quarter;
    joint.in_b = joint.in_b * quarter.inverse();
  }
  const auto sign = [&](int joint) { return r.swapped[joint] ? -1.0 : 1.0; };
  for (RandomGear& gear : r.mechanism.gears) gear.ratio *= sign(gear.first) * sign(gear.second);
  for (RandomDrive& drive : r.mechanism.drives) drive.acceleration *= sign(drive.joint);
  for (RandomSpring& spring : r.mechanism.springs) {
    std::swap(spring.a, spring.b);
    std::swap(spring.at_a, spring.at_b);
  }
  return r;
}

/// mm, t and a unit of time of 0.1 s.
Rewriting other_units(const RandomMechanism& before) {
  Rewriting r(before);
  r.length = 1e3, r.mass = 1e-3, r.time = 10.0;
  RandomMechanism& m = r.mechanism;
  m.units = {{1e-3, "mm"}, {1e3, "t"}, {0.1, "ds"}};
  const double stiffness = r.mass / (r.time * r.time);
  const auto coordinate = [&](int joint) { return before.joints[joint].along ? r.length : 1.0; };
  m.gravity *= r.length / (r.time * r.time);
  for (RandomBody& body : m.bodies) {
    body.mass *= r.mass;
    body.center *= r.length;
    body.inertia *= r.mass * r.length * r.length;
    body.pose.p *= r.length;
    body.velocity *= r.length / r.time;
    body.omega /= r.time;
  }
  for (std::size_t i = 0; i < m.joints.size(); ++i) {
    RandomJoint& joint = m.joints[i];
    joint.in_a.p *= r.length;
    joint.in_b.p *= r.length;
    joint.pitch *= r.length;
    joint.value *= coordinate(static_cast<int>(i));
    joint.rate *= coordinate(static_cast<int>(i)) / r.time;
  }
  for (RandomSpring& spring : m.springs) {
    spring.at_a *= r.length;
    spring.at_b *= r.length;
    spring.free *= r.length;
    spring.stiffness *= stiffness;
    spring.damping *= stiffness * r.time;
  }
  for (RandomGear& gear : m.gears) gear.ratio *= coordinate(gear.second) / coordinate(gear.first);
  for (RandomDrive& drive : m.drives) drive.acceleration *= coordinate(drive.joint) / (r.time * r.time);
  return r;
}

/// The whole scene turned and moved by some of its size, with its gravity.
Rewriting other_pose(const RandomMechanism& before) {
  Rewriting r(before);
  r.world = {{1.3, -2.1, 0.8}, Eigen::AngleAxisd(1.9, Vector3d(0.3, -0.7, 0.5).normalized()).toRotationMatrix()};
  RandomMechanism& m = r.mechanism;
  m.gravity = r.world.R * m.gravity;
  for (RandomBody& body : m.bodies) {
    body.pose = r.world * body.pose;
    body.velocity = r.world.R * body.velocity;
    body.omega = r.world.R * body.omega;
  }
  for (RandomJoint& joint : m.joints) {
    if (joint.a < 0) joint.in_a = r.world * joint.in_a;
    if (joint.b < 0) joint.in_b = r.world * joint.in_b;
  }
  for (RandomSpring& spring : m.springs)
    if (spring.a < 0) spring.at_a = (r.world * Frame{spring.at_a, Matrix3d::Identity()}).p;
  return r;
}

/// Every body in two parts, 0.4 and 0.6 of its mass a little apart, that a fixed joint holds together; every second
/// joint and spring acts on the second part. By Steiner the parts have I - m 0.4 0.6 (|d|² - d dᵀ) together.
Rewriting split_bodies(const RandomMechanism& before) {
  Rewriting r(before);
  RandomMechanism& m = r.mechanism;
  const int count = static_cast<int>(before.bodies.size());
  const Vector3d d(0.06, -0.04, 0.05);
  for (int i = 0; i < count; ++i) {
    RandomBody first = m.bodies[i], second = first;
    const Matrix3d steiner = d.squaredNorm() * Matrix3d::Identity() - d * d.transpose();
    const Matrix3d rest = first.inertia - 0.24 * first.mass * steiner;
    second.name += "_rest";
    second.mass = 0.6 * first.mass;
    second.center = first.center + 0.4 * d;
    second.inertia = 0.6 * rest;
    first.mass *= 0.4;
    first.center -= 0.6 * d;
    first.inertia = 0.4 * rest;
    m.bodies[i] = first;
    m.bodies.push_back(second);
    RandomJoint weld;
    weld.name = "weld_" + first.name;
    weld.a = i;
    weld.b = count + i;
    weld.in_a.p = weld.in_b.p = Vector3d(0.2, 0.1, -0.3);
    m.joints.push_back(weld);
  }
  for (std::size_t i = 0; i < before.joints.size(); i += 2) m.joints[i].b += m.joints[i].b < 0 ? 0 : count;
  for (std::size_t i = 1; i < before.joints.size(); i += 2) m.joints[i].a += m.joints[i].a < 0 ? 0 : count;
  for (RandomSpring& spring : m.springs) spring.b += count;
  return r;
}

template <class Rewrite>
void expect_same_start(Rewrite rewrite) {
  for (unsigned seed = 0; seed < mechanisms; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMechanism before = random_mechanism(seed, every_joint(), every_joint());
    const Rewriting rewriting = rewrite(before, seed);
    const Differences difference =
        compare(start_of_motion(before), original(rewriting, before, start_of_motion(rewriting.mechanism)));
    // Round-off times the condition number of the constraints, at most 1e4 (see random_mechanism()).
    EXPECT_LT(difference.accelerations, 1e-12);
    EXPECT_LT(difference.reactions, 1e-12);
    EXPECT_LT(difference.others, 1e-12);
  }
}

TEST(Rewritings, OrderOfBodiesAndJoints) { expect_same_start(other_order); }
TEST(Rewritings, SidesOfJointsAndSprings) {
  expect_same_start([](const RandomMechanism& before, unsigned) { return other_sides(before); });
}
TEST(Rewritings, Units) {
  expect_same_start([](const RandomMechanism& before, unsigned) { return other_units(before); });
}
TEST(Rewritings, PoseOfTheScene) {
  expect_same_start([](const RandomMechanism& before, unsigned) { return other_pose(before); });
}
TEST(Rewritings, BodiesInTwoParts) {
  expect_same_start([](const RandomMechanism& before, unsigned) { return split_bodies(before); });
}

// The mechanisms are those of which the rewritings speak: every kind of joint, loops, gears and drives, and motion.
TEST(Rewritings, AreOfMechanismsWithEverything) {
  std::vector<int> of_kind(every_joint().size(), 0);
  int loops = 0, gears = 0, drives = 0;
  for (unsigned seed = 0; seed < mechanisms; ++seed) {
    const RandomMechanism m = random_mechanism(seed, every_joint(), every_joint());
    for (const RandomJoint& joint : m.joints) {
      ++of_kind[static_cast<int>(joint.kind)];
      loops += joint.closes_loop;
    }
    gears += static_cast<int>(m.gears.size());
    drives += static_cast<int>(m.drives.size());
  }
  EXPECT_GE(*std::min_element(of_kind.begin(), of_kind.end()), 3);
  EXPECT_GE(loops, 5);
  EXPECT_GE(gears, 3);
  EXPECT_GE(drives, 3);
}

}  // namespace
}  // namespace tisserand::mechanism::rewritings_test

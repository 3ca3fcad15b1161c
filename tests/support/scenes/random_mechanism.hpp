// SPDX-License-Identifier: GPL-3.0-or-later
// Random mechanisms of rigid bodies: trees and loops of all joints in a random consistent state, and what they do at
// it.
// In C++17, for programs whose other headers know no later one.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/units.hpp"

namespace tisserand::formats {
enum class JointKind;
struct Scene;
}  // namespace tisserand::formats

namespace tisserand::test_support {

/// A pose in the axes of a body, or in the world.
struct Frame {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();

  Frame operator*(const Frame& inner) const { return {p + R * inner.p, R * inner.R}; }
  Frame inverse() const { return {-(R.transpose() * p), R.transpose()}; }
};

struct RandomBody {
  std::string name;
  double mass = 1.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();       ///< of mass, axes of the body
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();  ///< about it
  Frame pose;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the origin, world
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();     ///< world
};

/// From body a to body b (rows of the list; -1: ground), at frames in their axes.
struct RandomJoint {
  std::string name;
  formats::JointKind kind{};
  int a = -1;
  int b = 0;
  Frame in_a;
  Frame in_b;
  double pitch = 0.0;              ///< of screws
  std::array<bool, 6> hold{};      ///< of generic joints
  bool closes_loop = false;        ///< b hangs on another joint already
  bool along = false;              ///< its coordinate that gears and drives use is z, not the angle
  double value = 0.0, rate = 0.0;  ///< of that coordinate
};

/// Between two points, with damper.
struct RandomSpring {
  std::string name;
  int a = -1;
  int b = 0;
  Eigen::Vector3d at_a, at_b;
  double stiffness = 0.0, damping = 0.0, free = 0.0;
};

/// Coordinates of two joints: change of the second = ratio × change of the first.
struct RandomGear {
  std::string name;
  int first = 0;
  int second = 0;
  double ratio = 1.0;
};

/// The coordinate of a joint with its present value and rate, and this second derivative.
struct RandomDrive {
  std::string name;
  int joint = 0;
  double acceleration = 0.0;
};

struct RandomMechanism {
  Units units = Units::si();
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::vector<RandomBody> bodies;
  std::vector<RandomJoint> joints;
  std::vector<RandomSpring> springs;
  std::vector<RandomGear> gears;
  std::vector<RandomDrive> drives;
};

/// Joints of one body each, in a tree; of the list `closing` up to two more, closing loops. The same for the same seed
/// on every machine with the same standard library. Constraints are independent (smallest singular value of the scaled
/// Jacobian above 1e-2 of the largest) and leave a degree of freedom; velocities meet them.
RandomMechanism random_mechanism(unsigned seed, const std::vector<formats::JointKind>& kinds,
                                 const std::vector<formats::JointKind>& closing);

/// The word of its kind.
std::string word_of(const RandomJoint& joint);

formats::Scene scene_of(const RandomMechanism& mechanism);

/// What a mechanism does at its start, in its units and axes.
struct Motion {
  Eigen::Vector3d acceleration;          ///< of the origin of the body, world
  Eigen::Vector3d angular_acceleration;  ///< world
};
struct Wrench {
  Eigen::Vector3d force;   ///< world
  Eigen::Vector3d moment;  ///< about the origin of frame b, world
};
struct StartOfMotion {
  std::vector<Motion> bodies;
  std::vector<Wrench> joints;                ///< of a on b
  std::vector<double> springs;               ///< force, positive where it drives apart
  std::vector<std::array<double, 2>> gears;  ///< along the first and the second coordinate
  std::vector<double> drives;                ///< along the coordinate
};

/// By the mechanism: the row of results at the start of dynamics.
StartOfMotion start_of_motion(const RandomMechanism& mechanism);

/// The largest differences of the entries of each kind, relative to the largest entries of that kind.
struct Differences {
  double accelerations = 0.0;
  double reactions = 0.0;
  double others = 0.0;  ///< springs, gears, drives
};
Differences compare(const StartOfMotion& a, const StartOfMotion& b);

}  // namespace tisserand::test_support

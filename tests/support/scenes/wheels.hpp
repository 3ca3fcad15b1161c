// SPDX-License-Identifier: GPL-3.0-or-later
// Wheels and a car of one body on roads, for tests of tyres and roads.
#pragma once

#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support {

/// The wheel of these scenes, of comprehensive slip.
struct Wheel {
  static constexpr double gravity = 9.81, mass = 50.0, inertia = 1.5, stiffness = 190e3, radius = 0.31;
};

/// Its tyre on the road "road", named after the position in millimetres.
formats::TyreSpec tyre_on(const std::string& node, const Eigen::Vector3d& position);

/// The plane "road", which falls by `angle` towards x.
formats::RoadSpec slope(double angle);

/// A wheel in the plane y = 0 on a road that falls by `angle` towards x, pressed in as at rest; moving along it,
/// rolling or locked.
formats::Scene wheel_on_slope(double angle, double speed, bool locked);

/// The car of the second paper as one body: 980 kg, wheels that do not turn; `height` above its place at rest.
formats::Scene block_car(double height);

}  // namespace tisserand::test_support

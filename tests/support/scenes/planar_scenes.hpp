// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of the x-y plane, turned and moved as a whole, for tests of planar models.
#pragma once

#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support {

/// Rotations of a scene: none, z to −y, a general one.
inline const Eigen::Quaterniond upright = Eigen::Quaterniond::Identity();
inline const Eigen::Quaterniond on_edge(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()));
inline const Eigen::Quaterniond askew(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()));

struct TurnedScene {
  Eigen::Quaterniond q;
  formats::Scene scene;

  explicit TurnedScene(const Eigen::Quaterniond& turn);
  Eigen::Vector3d vector(const Eigen::Vector3d& v) const { return q * v; }
  void add(formats::BodySpec body, const Eigen::Vector3d& position, double angle, const Eigen::Vector3d& velocity,
           double omega);
  void hinge(const std::string& name, const std::string& a, const std::string& b, const Eigen::Vector3d& at);
  void slide(const std::string& name, const std::string& b, const Eigen::Vector3d& at);
};

/// `effects: {planar: on}`, or off.
formats::EffectSwitch planar(bool on);
formats::Scene with_planar(formats::Scene scene);

/// Crank, rod and slider of rigid bodies, with a spring, a damper, a load that follows and one that does not.
TurnedScene rigid_slider_crank(const Eigen::Quaterniond& q);

/// A driven crank, a flexible rod and its guide, as in examples/slider_crank. The file "rod" has `modes` of the 18
/// internal modes.
TurnedScene flexible_slider_crank(const Eigen::Quaterniond& q, formats::InertiaOption inertia);
mechanism::BodyFiles rod_files(int modes);

/// Slider-crank with a modal body as rod. Two of its modes of each frequency bend it, in all directions alike.
TurnedScene modal_slider_crank(const Eigen::Quaterniond& q);
mechanism::BodyFiles modal_rod_files(int modes);

/// The spin-up of a second-order beam about its root.
TurnedScene spin_up(const Eigen::Quaterniond& q);
mechanism::BodyFiles second_order_files();

/// A wheel that rolls down a slope and is braked, over a bump where there is one.
TurnedScene braked_wheel(const Eigen::Quaterniond& q, std::optional<double> relaxation, bool bump);

}  // namespace tisserand::test_support

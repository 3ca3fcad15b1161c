// SPDX-License-Identifier: GPL-3.0-or-later
// A very stiff internal mode (benchmark 8.5 of the collection in shared/data): 1e6 rad/s at steps of 1e-3.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::stiff_mode_test {
namespace {

using Eigen::Vector3d;
using formats::Formulation;
using test_support::Simulation;

/// A soft bar of 0.6 m whose only internal mode has 1e6 rad/s in place of its own frequency.
SuperelementFiles bar() {
  test_support::BeamData data;
  data.length = 0.6;
  data.young = 1e9;
  data.shear_modulus = 4e8;
  data.density = 1000.0;
  formats::Superelement element = test_support::craig_bampton_beam(data, 1);
  element.stiffness(12, 12) = 1e12;
  SuperelementFiles files;
  test_support::add_file("bar", element, files);
  return files;
}

/// The bar on a hinge, driven by a moment that begins smoothly.
formats::Scene driven(double rho, Formulation formulation, double step, int modes) {
  formats::Scene scene = test_support::empty_scene(step, 1.0);
  scene.integrator.rho = rho;
  scene.integrator.formulation = formulation;
  scene.integrator.tolerance = 1e-10;
  formats::SuperelementBodySpec body = test_support::superelement_body("bar", "bar");
  body.modes = modes;
  scene.bodies.push_back(body);
  scene.joints.push_back(
      test_support::joint("hinge", formats::JointKind::revolute, "ground", "bar/base", Vector3d::Zero(), {0, 1, 0}));
  scene.loads.push_back(test_support::constant_load("drive", formats::LoadKind::moment, "bar/base", Vector3d::Zero()));
  scene.loads.back().components[1] = formats::TimeExpression{"0.6*sin(10*t)^2", {}, ""};
  return scene;
}

/// Tip [position; velocity] every 5e-3, and the largest internal coordinate.
struct Motion {
  std::vector<Eigen::Matrix<double, 6, 1>> tip;
  double mode = 0.0;
};

Motion move(const formats::Scene& scene, const SuperelementFiles& files) {
  Simulation run(scene, files);
  run.start();
  Motion motion;
  for (int k = 1; k <= 60; ++k) {
    run.run(5e-3 * k);
    motion.tip.emplace_back() << run.position("bar/tip"), run.velocity("bar/tip");
    if (run.state().y().size() > 0) motion.mode = std::max(motion.mode, run.state().y().cwiseAbs().maxCoeff());
  }
  return motion;
}

/// Largest differences of position and velocity.
Eigen::Vector2d difference(const Motion& a, const Motion& b) {
  Eigen::Vector2d largest = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < a.tip.size(); ++k) {
    const Eigen::Matrix<double, 6, 1> d = a.tip[k] - b.tip[k];
    largest = largest.cwiseMax(Eigen::Vector2d(d.head<3>().norm(), d.tail<3>().norm()));
  }
  return largest;
}

class StiffMode : public ::testing::TestWithParam<std::tuple<double, Formulation>> {};
INSTANTIATE_TEST_SUITE_P(Damping, StiffMode,
                         ::testing::Combine(::testing::Values(0.0, 0.5, 0.9),
                                            ::testing::Values(Formulation::index3, Formulation::stabilised_index2)));

// The mode follows the motion statically, with 1e-12 of the acceleration; a step of 1e3 of its radians must neither
// excite it nor cost the slow motion its order.
TEST_P(StiffMode, ChangesNothingOfTheSlowMotion) {
  const auto [rho, formulation] = GetParam();
  const SuperelementFiles files = bar();
  const auto moved = [&, r = rho, f = formulation](double step, int modes) {
    return move(driven(r, f, step, modes), files);
  };
  const Motion with = moved(1e-3, 1), without = moved(1e-3, 0);
  EXPECT_LT(with.tip.back().z(), -0.1);
  const Eigen::Vector2d change = difference(with, without);
  EXPECT_LT(change[0], 1e-6 * 0.6);
  EXPECT_LT(change[1], 1e-6 * with.tip.back().tail<3>().norm());
  // Bounded: some times the static value, 1e-12 · 20 rad/s² · 0.3 m · sqrt(0.24 kg) = 3e-12, but felt.
  EXPECT_LT(with.mode, 3e-11);
  EXPECT_GT(with.mode, 1e-13);
  const Motion exact = moved(1e-4, 0);
  const double coarse = difference(with, exact)[0], fine = difference(moved(5e-4, 1), exact)[0];
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

}  // namespace
}  // namespace tisserand::mechanism::stiff_mode_test

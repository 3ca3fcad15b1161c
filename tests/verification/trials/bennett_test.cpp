// Random Bennett linkages: overconstrained, of one degree of freedom, and regular at every position.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "mechanism/simulate.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::bennett_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// From the axis of one joint to the next: a turn θ about z, then a link of length a along x that twists by α (Denavit
/// and Hartenberg).
Isometry3d link(double theta, double length, double twist) {
  return Eigen::AngleAxisd(theta, Vector3d::UnitZ()) * Eigen::Translation3d(length, 0, 0) *
         Eigen::AngleAxisd(twist, Vector3d::UnitX());
}

/// Places of the four axes of a linkage with sin α/a = sin β/b, closed by tan(θ₁/2) tan(θ₂/2) = sin((β + α)/2)/sin((β −
/// α)/2) (Bennett, Engineering 76, 1903, 777).
std::vector<Isometry3d> random_linkage(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  for (;;) {
    const double a = between(0.5, 1.5), alpha = between(0.3, 1.3), beta = between(1.4, 2.6);
    const double b = a * std::sin(beta) / std::sin(alpha);
    const double first = (random() % 2 == 0 ? 1.0 : -1.0) * between(0.5, 2.6);
    if (b < 0.2 || b > 3.0) continue;
    for (const double sign : {1.0, -1.0}) {
      const double ratio = sign * std::sin(0.5 * (beta + alpha)) / std::sin(0.5 * (beta - alpha));
      const double second = 2.0 * std::atan(ratio / std::tan(0.5 * first));
      std::vector<Isometry3d> axes = {Isometry3d::Identity()};
      for (const Isometry3d& next :
           {link(first, a, alpha), link(second, b, beta), link(-first, a, alpha), link(-second, b, beta)})
        axes.push_back(axes.back() * next);
      if (axes.back().isApprox(Isometry3d::Identity(), 1e-9)) return axes;
    }
  }
}

formats::Scene falling(const std::vector<Isometry3d>& axes) {
  formats::Scene scene = test_support::empty_scene(1e-3, 3.0);
  scene.output.interval = 0.1;
  scene.gravity = {0, 0, -9.81};
  const std::vector<std::string> names = {"ground", "l1", "l2", "l3", "ground"};
  for (int i = 0; i < 3; ++i) {
    const double mass = 1.0 + 0.5 * i, half = (axes[i + 1].translation() - axes[i].translation()).norm() / 2.0;
    formats::RigidBodySpec body =
        test_support::rigid_body(names[i + 1], mass, {-half, 0.1, 0.05}, mass * Vector3d(0.01, 0.05, 0.06));
    body.start.pose = {axes[i + 1].translation(), Eigen::Quaterniond(axes[i + 1].linear())};
    scene.bodies.emplace_back(body);
  }
  for (int i = 0; i < 4; ++i)
    scene.joints.push_back(test_support::joint("j" + std::to_string(i + 1), formats::JointKind::revolute, names[i],
                                               names[i + 1], axes[i].translation(), axes[i].linear().col(2)));
  return scene;
}

/// Index 2, index 3, HHT, controlled steps and Radau: none fails, none gains or loses a ten-thousandth of the energy.
void run(unsigned seed, int count) {
  std::mt19937 random(seed);
  for (int k = 0; k < count; ++k) {
    const std::vector<Isometry3d> axes = random_linkage(random);
    for (int method = 0; method < 5; ++method) {
      formats::Scene scene = falling(axes);
      formats::IntegratorSpec& integrator = scene.integrator;
      if (method == 1) integrator.formulation = formats::Formulation::index3;
      if (method == 2) integrator.method = formats::Method::hht;
      if (method > 2) integrator.error_control = {true, method == 3 ? 1e-4 : 1e-8};
      if (method == 4) integrator.method = formats::Method::radau;
      const test_support::TemporaryFolder folder;
      const RunReport report = simulate(scene, folder.file("a.results.h5"), {});
      EXPECT_EQ(report.outcome, RunOutcome::completed) << k << ", method " << method << ": " << report.reason;
      EXPECT_LT(report.largest_balance, 1e-4 * report.energy_reference) << k << ", method " << method;
      EXPECT_THAT(report.doubts, ::testing::IsEmpty()) << k << ", method " << method;
    }
  }
}

TEST(RandomBennett, TenLinkagesWithEveryMethod) { run(1, 10); }
TEST(RandomBennett, AHundredLinkagesWithEveryMethod) { run(2, 100); }

}  // namespace
}  // namespace tisserand::mechanism::bennett_test

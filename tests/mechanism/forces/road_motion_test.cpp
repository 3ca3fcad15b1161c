// SPDX-License-Identifier: GPL-3.0-or-later
// Wheels and a car on roads with heights over grids and along lines: the same bump written three ways, energy over a
// hill, ends and holes.
#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "mechanism/run/limits.hpp"
#include "tests/support/scenes/wheels.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::mechanism::road_motion_test {
namespace {

using Eigen::Vector3d;
using formats::RoadPieceShape;
using test_support::block_car;
using test_support::Simulation;
using test_support::slope;
using test_support::wheel_on_slope;

constexpr double g = test_support::Wheel::gravity, mass = test_support::Wheel::mass,
                 inertia = test_support::Wheel::inertia, stiffness = test_support::Wheel::stiffness,
                 radius = test_support::Wheel::radius;

/// Road with the height z(x) on a strip 4 m wide from x = -5 to 6 m, every 5 mm.
template <class Height>
formats::RoadSpec grid_road(const Height& z) {
  formats::RoadHeights heights;
  for (int i = 0; i <= 2200; ++i) heights.along.push_back(-5.0 + 0.005 * i);
  heights.across = {-2.0, 0.0, 2.0};
  heights.height.resize(2201, 3);
  for (int i = 0; i <= 2200; ++i) heights.height.row(i).setConstant(z(heights.along[static_cast<std::size_t>(i)]));
  formats::RoadSpec road;
  road.name = "road";
  road.kind = formats::RoadKind::grid;
  road.heights = std::make_shared<const formats::RoadHeights>(std::move(heights));
  return road;
}

/// Road of the same heights along a straight line elsewhere. Its pose moves the line back to that of `grid`.
formats::RoadSpec crg_road(const formats::RoadSpec& grid) {
  formats::RoadHeights heights = *grid.heights;
  const Eigen::Rotation2Dd heading(0.7);
  heights.line.resize(2, 2);
  heights.line.col(0) = Eigen::Vector2d(300.0, -200.0);
  heights.line.col(1) = heights.line.col(0) + heading * Eigen::Vector2d(11.0, 0.0);
  formats::RoadSpec road = grid;
  road.kind = formats::RoadKind::crg;
  road.pose.orientation = Eigen::AngleAxisd(-0.7, Vector3d::UnitZ());
  road.pose.position = Vector3d(-5.0, 0.0, 0.0) - road.pose.orientation * Vector3d(300.0, -200.0, 0.0);
  road.heights = std::make_shared<const formats::RoadHeights>(std::move(heights));
  return road;
}

/// A wheel that rolls along x on the road at the speed, without resistance.
formats::Scene wheel_on(const formats::RoadSpec& road, double speed) {
  formats::Scene scene = wheel_on_slope(0.0, speed, false);
  const double rolling_radius = radius - mass * g / stiffness / 3.0;
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = Vector3d(0, speed / rolling_radius, 0);
  scene.roads = {road};
  return scene;
}

// A cosine bump as profile, as grid and along a line. The grid errs by h² Δz''/16 = 1.5e-6 at the feet, where the
// curvature jumps. Line and grid differ by round-off of coordinates of size 300.
TEST(RollingWheel, MeetsTheSameBumpHoweverItIsWritten) {
  formats::RoadSpec profile = slope(0.0);
  profile.kind = formats::RoadKind::profile;
  profile.left = profile.right = {{RoadPieceShape::cosine, 1.0, 1.0, 0.05, 0.0, {}}};
  const formats::RoadSpec grid = grid_road(
      [](double x) { return x > 1.0 && x < 2.0 ? 0.025 * (1.0 - std::cos(2.0 * std::numbers::pi * x)) : 0.0; });
  std::vector<std::vector<Vector3d>> paths;
  for (const formats::RoadSpec& road : {profile, grid, crg_road(grid)}) {
    Simulation run(wheel_on(road, 5.0), {});
    run.start();
    paths.emplace_back();
    run.run(0.6, [&] { paths.back().push_back(run.position("wheel")); });
  }
  double highest = 0.0, to_grid = 0.0, to_line = 0.0;
  for (std::size_t i = 0; i < paths[0].size(); ++i) {
    highest = std::max(highest, paths[0][i].z());
    to_grid = std::max(to_grid, (paths[1][i] - paths[0][i]).norm());
    to_line = std::max(to_line, (paths[2][i] - paths[1][i]).norm());
  }
  EXPECT_GT(highest, radius + 0.05);
  EXPECT_GT(to_grid, 0.0);
  EXPECT_LT(to_grid, 1e-5);
  EXPECT_LT(to_line, 1e-9);
}

// Over a hill of height H without resistance, ½ (m + I/R²) v² + m g z is constant. Dissipation of the tyre in slip and
// damper is accounted for.
TEST(RollingWheel, KeepsItsEnergyOverAHill) {
  const double H = 0.1, v = 3.0, R = radius - mass * g / stiffness / 3.0;
  formats::Scene scene = wheel_on(grid_road([H](double x) {
                                    const double s = (x - 3.0) / 2.0;
                                    return std::abs(s) < 1.0 ? H * std::pow(1.0 - s * s, 3) : 0.0;
                                  }),
                                  v);
  scene.integrator.step = 5e-4;
  scene.tyres[0].damping = 0.0;
  Simulation run(scene, {});
  run.start();
  const double before = run.energy().total();
  double top = 0.0, least = v;
  run.run(1.9, [&] {
    top = std::max(top, run.position("wheel").z());
    least = std::min(least, run.velocity("wheel").x());
  });
  EXPECT_GT(run.position("wheel").x(), 5.0);
  EXPECT_NEAR(top, radius + H, 0.005);
  EXPECT_NEAR(least, std::sqrt(v * v - 2.0 * g * H / (1.0 + inertia / (mass * R * R))), 0.01);
  EXPECT_NEAR(run.velocity("wheel").x(), v, 0.01);
  EXPECT_NEAR(run.energy().total() + run.state().dissipated(), before, 1e-4 * before);
}

TEST(RollingCar, IsReportedWhereGridsEndAndHaveHoles) {
  const auto reason = [](const formats::RoadSpec& road, double time) {
    formats::Scene scene = block_car(0.0);
    scene.roads = {road};
    for (formats::TyreSpec& tyre : scene.tyres) tyre.friction = 1e-6;
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = Vector3d(10.0, 0, 0);
    Simulation run(scene, {});
    run.start();
    run.run(time);
    return off_road(run.model(), run.state(), run.workspace.now);
  };
  const formats::RoadSpec level = grid_road([](double) { return 0.0; });
  EXPECT_EQ(reason(level, 0.55), "");
  EXPECT_EQ(reason(level, 0.601),
            "t = 0.601 s: tyre 'tyre7150' has left the road 'road', which ends at x = 6 m; give it "
            "more heights, or end the run earlier");
  EXPECT_NE(reason(crg_road(level), 0.601).find("which ends at u = 6 m"), std::string::npos);
  formats::RoadSpec holed = crg_road(level);
  formats::RoadHeights heights = *holed.heights;
  heights.height(1200, 2) = std::nan("");  // u = 1, v = 2: the cells from v = 0 on
  holed.heights = std::make_shared<const formats::RoadHeights>(heights);
  EXPECT_EQ(reason(holed, 0.099), "");
  const std::string hole = reason(holed, 0.1);
  EXPECT_NE(hole.find("t = 0.1 s: tyre 'tyre7150' has reached a hole of the road 'road' at u = "), std::string::npos);
  EXPECT_NE(hole.find("v = 0.715 m; give heights there"), std::string::npos) << hole;
}

TEST(TyreBuild, RefusesGridsThatAreNotUnderTheWheels) {
  const auto error = [](const formats::RoadSpec& road) {
    formats::Scene scene = block_car(0.0);
    scene.roads = {road};
    return test_support::error_of([&] { build_model(scene, {}); });
  };
  const formats::RoadSpec level = grid_road([](double) { return 0.0; });
  const auto changed = [](formats::RoadSpec road, auto change) {
    formats::RoadHeights heights = *road.heights;
    change(heights);
    road.heights = std::make_shared<const formats::RoadHeights>(std::move(heights));
    return road;
  };
  EXPECT_EQ(error(level), "no error");
  EXPECT_NE(error(changed(level,
                          [](formats::RoadHeights& h) {
                            h.across = {-0.72, 0.0, 0.72};
                          }))
                .find("starts at y = 0.73 m of the road 'road', which extends from -0.72 to 0.72"),
            std::string::npos);
  EXPECT_NE(error(changed(level, [](formats::RoadHeights& h) { h.height(1000, 2) = std::nan(""); }))
                .find("tyre 'tyre7150' starts in a hole of the road 'road'"),
            std::string::npos);
  EXPECT_NE(error(changed(crg_road(level),
                          [](formats::RoadHeights& h) {
                            const Eigen::Matrix2Xd ends = h.line;
                            h.line.resize(2, 2201);
                            for (Eigen::Index i = 0; i < 2201; ++i)
                              h.line.col(i) = ends.col(0) +
                                              static_cast<double>(i) / 2200.0 * (ends.col(1) - ends.col(0)) +
                                              Eigen::Vector2d(0.0, i > 1100 ? 0.003 : 0.0);
                          }))
                .find("road 'road': its reference line bends so sharply at u = 0"),
            std::string::npos);
}

}  // namespace
}  // namespace tisserand::mechanism::road_motion_test

// SPDX-License-Identifier: GPL-3.0-or-later
// Wheels and cars on roads in motion and at rest, against mechanics on paper.
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/tyres/tyre_property_file.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/bdf/bdf.hpp"
#include "mechanism/doubts/doubt.hpp"
#include "mechanism/run/limits.hpp"
#include "tests/support/scenes/model_tangent.hpp"
#include "tests/support/scenes/wheels.hpp"

namespace tisserand::mechanism::tyre_motion_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using formats::Method;
using formats::RoadPieceShape;
using test_support::block_car;
using test_support::Simulation;
using test_support::slope;
using test_support::wheel_on_slope;

constexpr double g = test_support::Wheel::gravity, mass = test_support::Wheel::mass,
                 inertia = test_support::Wheel::inertia, stiffness = test_support::Wheel::stiffness,
                 radius = test_support::Wheel::radius;

/// Slip at which the patch makes the force F under the load N: F = μ N (1 − l_n³), C_s S = 3 μ N (1 − l_n).
double slip_of(double F, double N) {
  const double mu = 0.8, l_n = std::cbrt(1.0 - F / (mu * N));
  return 3.0 * mu * N * (1.0 - l_n) / 80e3;
}

/// m a = m g sin θ − F, I a (1 − S)/R = F R: a disc that rolls down with the slip of its own friction.
double rolling_acceleration(double angle) {
  const double N = mass * g * std::cos(angle), R = radius - N / stiffness / 3.0;
  double S = 0.0, a = 0.0;
  for (int i = 0; i < 50; ++i) {
    a = g * std::sin(angle) / (1.0 + inertia * (1.0 - S) / (mass * R * R));
    S = slip_of(mass * (g * std::sin(angle) - a), N);
  }
  return a;
}

class Methods : public ::testing::TestWithParam<Method> {};

// Above v₀ (passed after 0.05 s) slip and acceleration are constant. The methods err by their tolerances: 1e-6 of the
// velocity for bdf; for the others the acceleration is that of a linear system with a constant force.
TEST_P(Methods, RollDownASlopeAsADiscDoes) {
  const double angle = 0.2;
  formats::Scene scene = wheel_on_slope(angle, 1.0, false);
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = Vector3d(0, 1.0 / radius, 0);
  scene.integrator.method = GetParam();
  scene.integrator.alpha = 0.05;
  if (GetParam() == Method::bdf && !bdf_available()) GTEST_SKIP() << "this build has no CVODE";
  Simulation run(scene, {});
  run.start();
  std::unique_ptr<Bdf> bdf;
  if (GetParam() == Method::bdf) bdf = std::make_unique<Bdf>(run.scene, run.model(), run.state(), run.workspace);
  double reached = 0.0;
  const auto velocity_at = [&](double time) {
    if (!bdf) {
      run.run(time);
      return run.velocity("wheel").norm();
    }
    while (reached < time) {
      EXPECT_EQ(bdf->step({10.0, 10.0}), "");
      reached = run.state().time();
    }
    bdf->go_to(time);
    return run.velocity("wheel").norm();
  };
  const double v1 = velocity_at(1.0), v2 = velocity_at(2.0);
  EXPECT_NEAR(v2 - v1, rolling_acceleration(angle), 2e-5);
}

std::string method_name(const ::testing::TestParamInfo<Method>& given) {
  switch (given.param) {
    case Method::generalised_alpha:
      return "GeneralisedAlpha";
    case Method::hht:
      return "Hht";
    case Method::radau:
      return "Radau";
    case Method::bdf:
      return "Bdf";
    case Method::automatic:
      break;
  }
  return "Auto";
}

INSTANTIATE_TEST_SUITE_P(Every, Methods,
                         ::testing::Values(Method::generalised_alpha, Method::hht, Method::radau, Method::bdf),
                         method_name);

// A locked wheel slides downhill with a = g (μ cos θ − sin θ) against its motion until it stands after v²/(2 a). The
// last of it, below 3 μ N/C_s v₀/2 = 0.7 mm/s, creeps; then it stands on the slope and creeps at the speed whose slip
// carries it.
TEST(LockedWheel, BrakesToRestOnASlope) {
  const double angle = 0.1, v = 12.0, a = g * (0.8 * std::cos(angle) - std::sin(angle));
  Simulation run(wheel_on_slope(angle, v, true), {});
  run.start();
  const Vector3d from = run.position("wheel");
  run.run(0.5 * v / a);
  const double t = run.state().time();
  EXPECT_NEAR((run.position("wheel") - from).norm(), v * t - 0.5 * a * t * t, 1e-6);
  run.run(v / a + 0.1);
  const double stopped = (run.position("wheel") - from).norm();
  EXPECT_NEAR(stopped, v * v / (2.0 * a), 1e-4);
  run.run(v / a + 1.1);
  const double S = slip_of(mass * g * std::sin(angle), mass * g * std::cos(angle));
  const double creep = 0.1 * (1.0 - std::sqrt(1.0 - S * S)) / S;  // V = S (V² + v₀²)/(2 v₀)
  EXPECT_NEAR(run.velocity("wheel").norm(), creep, 1e-4 * creep);
  EXPECT_NEAR((run.position("wheel") - from).norm() - stopped, creep, 1e-3 * creep);
}

// A wheel that is led along x at V and from t = 0 on also across at V_y: the deflection of the tread is
// σ V_y/V (1 − exp(−V t/σ)) (the tail by τ changes it by τ V/σ = 2e-4 of that), with every method.
TEST_P(Methods, SideForceRelaxesOverItsLength) {
  constexpr double V = 10.0, Vy = 0.1, sigma = 0.4;
  formats::Scene scene = wheel_on_slope(0.0, 0.0, true);
  scene.joints[0].hold = {false, false, true, true, true, true};
  auto& wheel = std::get<formats::RigidBodySpec>(scene.bodies[0]);
  wheel.start.velocity = Vector3d(V, Vy, 0);
  wheel.mass = 1e9;  // keeps its velocity
  wheel.start.pose.position = Vector3d(0, 0, radius - 0.003);
  scene.joints[0].position = wheel.start.pose.position;
  scene.gravity.setZero();
  scene.tyres[0].friction = 10.0;
  scene.tyres[0].relaxation_length = sigma;
  scene.integrator.method = GetParam();
  scene.integrator.alpha = 0.05;
  scene.integrator.step = 5e-4;
  if (GetParam() == Method::bdf && !bdf_available()) GTEST_SKIP() << "this build has no CVODE";
  Simulation run(scene, {});
  run.start();
  std::unique_ptr<Bdf> bdf;
  if (GetParam() == Method::bdf) bdf = std::make_unique<Bdf>(run.scene, run.model(), run.state(), run.workspace);
  double reached = 0.0;
  for (const double time : {0.01, 0.04, 0.1, 0.3}) {
    while (bdf && reached < time) {
      EXPECT_EQ(bdf->step({10.0, 10.0}), "");
      reached = run.state().time();
    }
    if (bdf)
      bdf->go_to(time);
    else
      run.run(time);
    const double expected = sigma * Vy / V * (1.0 - std::exp(-V * time / sigma));
    EXPECT_NEAR(run.state().w()[1], expected, 3e-4 * sigma * Vy / V) << time;
  }
}

// A road of two frictions: a locked wheel on its left decelerates by μ g, on its right by a quarter of that, above the
// seam by the mean.
TEST(LockedWheel, FeelsTheFrictionOfItsSide) {
  for (const auto& [side, factor] : {std::pair{1.0, 1.0}, std::pair{-1.0, 0.25}, std::pair{0.0, 0.625}}) {
    formats::Scene scene = wheel_on_slope(0.0, 10.0, true);
    scene.roads[0].pose.position.y() = -side;
    scene.roads[0].friction_right = 0.25;
    Simulation run(scene, {});
    run.start();
    run.run(0.5);
    EXPECT_NEAR(10.0 - run.velocity("wheel").x(), 0.5 * 0.8 * factor * g, 1e-6) << side;
  }
}

// With relaxation a standing tyre holds a slope by the deflection of its tread, where one without creeps: locked on a
// slope of 0.1 rad it comes to rest with u = σ S, the slip S of the force it bears, and stays.
TEST(LockedWheel, StandsOnASlopeWithRelaxation) {
  const double angle = 0.1;
  formats::Scene scene = wheel_on_slope(angle, 1.0, true);
  scene.tyres[0].relaxation_length = 0.3;
  Simulation run(scene, {});
  run.start();
  run.run(3.0);
  const Vector3d at = run.position("wheel");
  run.run(8.0);
  EXPECT_LT((run.position("wheel") - at).norm(), 1e-9);
  EXPECT_LT(run.velocity("wheel").norm(), 1e-9);
  const double S = slip_of(mass * g * std::sin(angle), mass * g * std::cos(angle));
  EXPECT_NEAR(std::abs(run.state().w()[0]), 0.3 * S, 1e-6 * S);
}

// A wheel that touches down without turning spins up; what it gave to the road is gone, the rest is there: the balance
// closes (second order in the step), and V = Ω R with m (V₀ − V) R = I Ω but for the few per cent by which R moves.
TEST(FallingWheel, SpinsUpAndItsEnergyIsAccountedFor) {
  formats::Scene scene = wheel_on_slope(0.0, 10.0, false);
  scene.integrator.step = 2e-4;
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.pose.position.z() += 0.1;
  Simulation run(scene, {});
  run.start();
  const double before = run.energy().total();
  double highest = 0.0, lowest_force = 1.0;
  run.run(2.0, [&] {
    highest = std::max(highest, -run.workspace.now.tyres[0].penetration);
    lowest_force = std::min(lowest_force, run.workspace.now.tyres[0].force.z());
  });
  const double dissipated = run.state().dissipated(), after = run.energy().total();
  EXPECT_GT(highest, 0.05);
  EXPECT_GE(lowest_force, 0.0);
  EXPECT_GT(dissipated, 500.0);
  EXPECT_NEAR(after + dissipated, before, 2e-3 * dissipated);
  const double expected = 10.0 / (1.0 + inertia / (mass * radius * radius));
  EXPECT_NEAR(run.velocity("wheel").x(), expected, 0.02 * expected);
}

// Lever law: 980 kg · 0.872/2.18 = 392 kg on the front axle: 1922.8 N and 2884.1 N per wheel. The body pitches by
// (15.2 - 10.1) mm/2.18 m = 2.3e-3, which moves the centre of mass against the wheels by 1e-3 m: 1e-3 of the loads; at
// the pitched places the law is exact.
TEST(StandingCar, CarriesItsWeightByTheLeverLaw) {
  for (const double height : {0.0, 0.02}) {  // from the air too
    Simulation run(block_car(height), {});
    run.start();
    const StaticsReport report = solve_statics(run.model(), run.scene.statics, {}, run.state(), run.workspace);
    ASSERT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
    const std::vector<TyreTerms>& tyres = run.workspace.now.tyres;
    const Vector3d center = run.position("car");  // the node of a rigid body is its centre of mass
    const double front = tyres[0].contact.x(), rear = tyres[1].contact.x();
    const double share = (center.x() - rear) / (front - rear);
    EXPECT_NEAR(tyres[0].force.z(), 0.5 * 980.0 * g * share, 1e-4);
    EXPECT_NEAR(tyres[1].force.z(), 0.5 * 980.0 * g * (1.0 - share), 1e-4);
    EXPECT_NEAR(tyres[0].force.z(), 1922.8, 3.0);
    EXPECT_NEAR(tyres[1].force.z(), 2884.1, 3.0);
    EXPECT_NEAR(tyres[0].force.z(), tyres[2].force.z(), 1e-6);
    for (const TyreTerms& tyre : tyres) EXPECT_NEAR(tyre.force.head<2>().norm(), 0.0, 1e-9);
    // It goes on standing: no drift over 5 s, none of which a vehicle engineer could see.
    const Vector3d at = run.position("car");
    run.run(5.0);
    EXPECT_LT((run.position("car") - at).norm(), 1e-6);
  }
}

// A bump under both sides lifts and pitches the car, and gives no roll, no yaw and no side step but round-off.
TEST(RollingCar, StaysStraightOverABumpUnderBothSides) {
  formats::Scene scene = block_car(0.0);
  formats::RoadSpec& road = scene.roads[0];
  road.kind = formats::RoadKind::profile;
  road.left = road.right = {{RoadPieceShape::cosine, 1.0, 1.0, 0.05, 0.0, {}}};
  for (formats::TyreSpec& tyre : scene.tyres) tyre.friction = 1e-6;  // wheels that do not turn slide
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = Vector3d(16.667, 0, 0);
  Simulation run(scene, {});
  run.start();
  double lift = 0.0, pitch = 0.0, roll = 0.0, side = 0.0;
  run.run(0.5, [&] {
    const Eigen::Matrix3d R = run.rotation("car").toRotationMatrix();
    lift = std::max(lift, run.position("car").z());
    pitch = std::max(pitch, std::abs(R(2, 0)));
    roll = std::max({roll, std::abs(R(2, 1)), std::abs(R(1, 0))});
    side = std::max(side, std::abs(run.position("car").y()));
  });
  EXPECT_GT(lift, 0.01);
  EXPECT_GT(pitch, 0.005);
  EXPECT_LT(roll, 1e-12);
  EXPECT_LT(side, 1e-12);
}

// The whole iteration matrix with tyres, by differences of the residual, in motion.
TEST(RollingCar, TangentIsTheDerivativeOfTheResidual) {
  formats::Scene scene = block_car(-0.02);
  Simulation run(scene, {});
  run.start();
  test_support::randomise(run, 3, 0.005, 1.0);
  const int n = run.model().sizes.boundary;
  const Eigen::MatrixXd with_mass = test_support::iteration_matrix(run, {1, 0, 0});
  const Eigen::MatrixXd K = (test_support::iteration_matrix(run, {1, 0, 1}) - with_mass).topLeftCorner(n, n);
  const Eigen::MatrixXd C = test_support::damping_matrix(run);
  const Eigen::MatrixXd by_position = test_support::residual_difference(run, test_support::Argument::position, 1e-7);
  const Eigen::MatrixXd by_velocity = test_support::residual_difference(run, test_support::Argument::velocity, 1e-6);
  EXPECT_LT((K - by_position).cwiseAbs().maxCoeff(), 1e-4 * K.cwiseAbs().maxCoeff());
  EXPECT_LT((C - by_velocity).cwiseAbs().maxCoeff(), 1e-4 * C.cwiseAbs().maxCoeff());
}

TEST(TyreBuild, RefusesWhatCannotRoll) {
  const auto error = [](auto change) {
    formats::Scene scene = block_car(0.0);
    change(scene);
    try {
      build_model(scene, {});
    } catch (const Error& fault) {
      return std::string(fault.what());
    }
    return std::string();
  };
  EXPECT_NE(error([](formats::Scene& s) { s.roads[0].pose.position.z() = 0.25; }).find("deep in the road 'road'"),
            std::string::npos);
  EXPECT_NE(error([](formats::Scene& s) { s.tyres[0].axis = Vector3d(0, 0, 1); }).find("the wheel lies on its side"),
            std::string::npos);
  EXPECT_NE(error([](formats::Scene& s) {
              s.roads[0].left = {
                  {RoadPieceShape::curve, 0, 0, 0, 0, {formats::Interpolation::linear, {-1.0, 5.0}, {0.0, 0.0}}}};
            }).find("of the road 'road', which extends from -1 to 5"),
            std::string::npos);
  EXPECT_NE(error([](formats::Scene& s) {
              s.joints.push_back(
                  test_support::joint("hinge", JointKind::revolute, "ground", "car", {0, 0, 0.3}, {0.1, 1, 0}));
            }).find("5.71 degrees away from the axis of joint 'hinge'"),
            std::string::npos);
  EXPECT_NE(
      error([](formats::Scene& s) { s.tyres[0].relaxation_length = 0.01; }).find("less than a twentieth of its radius"),
      std::string::npos);
  formats::Scene high = block_car(2.0);
  EXPECT_EQ(build_model(high, {}).notes.size(), 4u);
}

/// The wheel with the tyre of the book's file.
formats::Scene wheel_by_file(double speed) {
  formats::Scene scene = wheel_on_slope(0.0, speed, false);
  formats::TyreSpec& tyre = scene.tyres[0];
  tyre.kind = formats::TyreKind::magic_formula;
  tyre.properties = std::make_shared<const formats::TyreProperties>(formats::read_tyre_property_file(
      std::string(TISSERAND_REFERENCES) + "/magic_formula/book_205_60R15.tir", Units::si()));
  tyre.radius = tyre.properties->coefficients.UNLOADED_RADIUS;
  return scene;
}

// A wheel that rolls stays in the range of its file, and nothing is said; one that spins leaves it.
TEST(TyreRange, IsReportedWhereItIsLeft) {
  for (const bool spins : {false, true}) {
    formats::Scene scene = wheel_by_file(10.0);
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = Vector3d(0, spins ? 100.0 : 32.0, 0);
    Simulation run(scene, {});
    run.start();
    const std::unique_ptr<Doubt> range = tyre_range(scene, run.model());
    run.run(0.2, [&] { range->observe({run.model(), run.state(), run.workspace.now}); });
    const std::vector<std::string> doubts = range->doubts(run.model(), {});
    ASSERT_EQ(doubts.size(), spins ? 1u : 0u);
    EXPECT_TRUE(!spins || doubts[0].find("longitudinal slip") != std::string::npos);
  }
}

// k δ + k₂ δ² has the slope √(k² + 4 k₂ F) at the load F: at the nominal one the stiffness of the file. And a note of
// what is not used.
TEST(TyreBuild, TakesTheFile) {
  const BuiltModel built = build_model(wheel_by_file(10.0), {});
  const Tyre& tyre = built.model.tyres[0];
  const auto& p = std::get<MagicFormulaLaw>(tyre.law).p;
  EXPECT_NEAR(std::sqrt(tyre.stiffness * tyre.stiffness + 4.0 * tyre.progressive * p.FNOMIN), p.VERTICAL_STIFFNESS,
              1e-9 * p.VERTICAL_STIFFNESS);
  ASSERT_EQ(built.notes.size(), 1u);
  EXPECT_NE(built.notes[0].find("book_205_60R15.tir (MF-Tyre 6.1): keys without effect here: ASPECT_RATIO"),
            std::string::npos);
  EXPECT_LT(built.notes[0].size(), 200U) << built.notes[0];  // six names, and how many more
  EXPECT_TRUE(built.notes[0].ends_with(" more")) << built.notes[0];
  formats::Scene flat = wheel_by_file(10.0);
  flat.tyres[0].pressure = 0.5e5;  // PRESMIN = 1e5
  const std::vector<std::string> notes = build_model(flat, {}).notes;
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("pressure 50000 is outside the range for which its file was fitted, 100000 to "),
            std::string::npos);
}

// A road that a curve gives ends: the run says which tyre has left it and where.
TEST(RollingCar, LeavesAnEndingRoad) {
  formats::Scene scene = block_car(0.0);
  formats::RoadSpec& road = scene.roads[0];
  road.kind = formats::RoadKind::profile;
  road.left = {{RoadPieceShape::curve, 0, 0, 0, 0, {formats::Interpolation::linear, {-5.0, 0.5}, {0.0, 0.0}}}};
  for (formats::TyreSpec& tyre : scene.tyres) tyre.friction = 1e-6;
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = Vector3d(10.0, 0, 0);
  Simulation run(scene, {});
  run.start();
  run.run(0.049);
  EXPECT_EQ(off_road(run.model(), run.state(), run.workspace.now), "");
  run.run(0.053);
  EXPECT_NE(off_road(run.model(), run.state(), run.workspace.now)
                .find("tyre 'tyre7150' has left the road 'road', which ends at x = 0.5 m; lengthen its curve"),
            std::string::npos);
}

}  // namespace
}  // namespace tisserand::mechanism::tyre_motion_test

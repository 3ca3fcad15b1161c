// SPDX-License-Identifier: GPL-3.0-or-later
// Static equilibrium of scenes: cantilevers of superelements and nonlinear beams, large rotations, scenes that can
// move.
#include "mechanism/analyses/statics.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/results/results.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::statics_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using formats::LoadKind;
using std::numbers::pi;
using test_support::BeamData;
using test_support::Simulation;

formats::Scene static_scene(int load_steps) {
  formats::Scene scene = test_support::empty_scene(1.0, 1.0);
  scene.analysis = formats::AnalysisKind::statics;
  scene.statics.load_steps = load_steps;
  return scene;
}

StaticsReport solve(Simulation& run) {
  run.start();
  return solve_statics(run.model(), run.scene.statics, {}, run.state(), run.workspace);
}

/// A superelement beam clamped at its base, its part frame turned by `pose`, with a force at the tip.
struct Cantilever {
  BeamData data;
  SuperelementFiles files;
  formats::Scene scene = static_scene(1);

  Cantilever(const Eigen::Quaterniond& pose, const Vector3d& force) {
    test_support::add_file("beam", test_support::craig_bampton_beam(data, 4), files);
    formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
    body.start.pose.orientation = pose;
    scene.bodies.push_back(body);
    scene.joints.push_back(test_support::joint("clamp", JointKind::fixed, "ground", "beam/base", {0, 0, 0}, {0, 0, 1}));
    scene.loads.push_back(test_support::constant_load("tip", LoadKind::force, "beam/tip", force));
  }
};

// P L³/(3 E I) and P L²/(2 E I); a force of 0.1 N turns the tip by 5e-5, whose square is the nonlinear remainder;
// positions rounded to 1e-16 are 1e-8 N.
TEST(SuperelementCantilever, TipDeflectionIsTheAnalyticOne) {
  const double P = 0.1;
  Cantilever c(Eigen::Quaterniond::Identity(), {0, P, 0});
  Simulation run(c.scene, c.files);
  const StaticsReport report = solve(run);
  ASSERT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  const double EI = c.data.young * c.data.Iz, L = c.data.length;
  EXPECT_NEAR(run.position("beam/tip").y() / (P * L * L * L / (3 * EI)), 1.0, 1e-6);
  EXPECT_NEAR(2 * run.rotation("beam/tip").z() / (P * L * L / (2 * EI)), 1.0, 1e-6);
  // The clamp carries −P and −P L about z.
  evaluate(run.model(), run.state(), run.workspace.now);
  const JointReaction r =
      joint_reaction(run.model().joints[0], NodeMotion{}, run.workspace.now.motion[0], run.state().lambda().data());
  EXPECT_LT((r.force - Vector3d(0, -P, 0)).norm(), 1e-6 * P);
  EXPECT_LT((r.moment - Vector3d(0, 0, -P * L)).norm(), 1e-6 * P * L);
}

// Turned by 90 degrees about z and pulled along its axis: elongation N L/(E A), nothing else.
TEST(SuperelementCantilever, PulledAndTurnedByNinetyDegrees) {
  const double N = 2e5;
  Cantilever c(Eigen::Quaterniond(Eigen::AngleAxisd(pi / 2, Vector3d::UnitZ())), {0, N, 0});
  Simulation run(c.scene, c.files);
  const StaticsReport report = solve(run);
  ASSERT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  const double stretch = N * c.data.length / (c.data.young * c.data.area);
  EXPECT_LT((run.position("beam/tip") - Vector3d(0, c.data.length + stretch, 0)).norm(), 1e-9 * stretch);
  EXPECT_LT(run.rotation("beam/tip").angularDistance(run.rotation("beam/base")), 1e-9);
}

// A moment bends a single superelement of two nodes into a rotation of 90 degrees: its linear law for the relative
// rotation, θ = M L/(E I), holds at any size because the frame turns with it.
TEST(SuperelementCantilever, MomentTurnsTheTipByNinetyDegrees) {
  Cantilever c(Eigen::Quaterniond::Identity(), {0, 0, 0});
  const double M = pi / 2 * c.data.young * c.data.Iz / c.data.length;
  c.scene.loads[0] = test_support::constant_load("tip", LoadKind::moment, "beam/tip", {0, 0, M});
  c.scene.statics.load_steps = 4;
  Simulation run(c.scene, c.files);
  const StaticsReport report = solve(run);
  ASSERT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  const Eigen::Matrix3d R = run.rotation("beam/tip").toRotationMatrix();
  EXPECT_NEAR(std::atan2(R(1, 0), R(0, 0)), pi / 2, 1e-7);
  // The frame lies at half the angle.
  EXPECT_NEAR(run.position("beam/tip").x(), run.position("beam/tip").y(), 1e-7);
}

formats::BeamBodySpec beam_body(const Vector3d& to, int elements) {
  formats::BeamBodySpec beam;
  beam.name = "beam";
  beam.to = to;
  beam.elements = elements;
  beam.nodes_per_element = 3;
  return beam;
}

// Bathe & Bolourchi's bend under 600 lb (references/README.md); 8 quadratic elements are within 0.1 %.
TEST(BeamScene, FortyFiveDegreeBend) {
  const std::vector<double> row = test_support::reference_rows("beam_bend_45.csv")[1];
  formats::Scene scene = static_scene(6);
  formats::BeamBodySpec beam = beam_body(100.0 * Vector3d(std::sin(pi / 4), std::cos(pi / 4) - 1.0, 0), 8);
  beam.through = 100.0 * Vector3d(std::sin(pi / 8), std::cos(pi / 8) - 1.0, 0);
  beam.section = test::rectangle(1.0, 1.0, row[0] / 5e6, 5.0 / 6.0);
  beam.material = test::material(1e7, 0.0, 1.0);
  scene.bodies.push_back(beam);
  scene.joints.push_back(test_support::joint("clamp", JointKind::fixed, "ground", "beam/start", {0, 0, 0}, {0, 0, 1}));
  scene.loads.push_back(test_support::constant_load("tip", LoadKind::force, "beam/end", {0, 0, 600}));
  Simulation run(scene, {});
  const Vector3d before = run.position("beam/16");
  const StaticsReport report = solve(run);
  ASSERT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  EXPECT_LT((run.position("beam/16") - before - Vector3d(row[1], row[2], row[3])).norm(), 1e-3 * 60);
}

// A moment 2 π E I/L rolls a cantilever into a circle: the tip comes back to the clamp after a full turn.
TEST(BeamScene, RollUp) {
  formats::Scene scene = static_scene(10);
  formats::BeamBodySpec beam = beam_body({10, 0, 0}, 10);
  beam.section = test::rectangle(1.0, 0.5, 0.1, 5.0 / 6.0);
  beam.material = test::material(1e6, 0.3, 1.0);
  scene.bodies.push_back(beam);
  scene.joints.push_back(test_support::joint("clamp", JointKind::fixed, "ground", "beam/start", {0, 0, 0}, {0, 0, 1}));
  const double EI = 1e6 * beam.section.second_moment_y;  // the section's y axis is the world's y
  scene.loads.push_back(test_support::constant_load("tip", LoadKind::moment, "beam/end", {0, -2 * pi * EI / 10, 0}));
  Simulation run(scene, {});
  const StaticsReport report = solve(run);
  ASSERT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  EXPECT_LT(run.position("beam/20").norm(), 1e-2);
  // Half way round stands the circle's opposite point: diameter L/π.
  EXPECT_NEAR(run.position("beam/10").norm(), 10 / pi, 1e-2);
}

/// A hub on a mast and a blade on a flapping hinge, which hangs on nothing but its centrifugal force.
struct FlappingBlade {
  static constexpr const char* text = R"yaml(scene: blade
analysis: statics
gravity: [0, 0, -9.81]
bodies:
  hub: {type: rigid, mass: 1, inertia: [1, 1, 1], nodes: {arm: {position: [0.1, 0, 0]}}}
  blade: {type: rigid, mass: 2, inertia: [0.01, 0.1, 0.1], center_of_mass: [0.5, 0, 0], pose: {position: [0.1, 0, 0]}}
joints:
  mast: {type: revolute, a: ground, b: hub, axis: [0, 0, 1]}
  flap: {type: revolute, a: hub/arm, b: blade, axis: [0, 1, 0]}
motions: {turn: {coordinate: mast, value: 20*t}}
statics: {rotation: {angular_velocity: [0, 0, 20]}}
)yaml";

  formats::Scene read(const std::vector<formats::Override>& overrides) const {
    std::ofstream(folder.file("blade.scene.yaml")) << text;
    return formats::read_scene(folder.file("blade.scene.yaml"), overrides);
  }
  test_support::TemporaryFolder folder;
};

TEST(SteadyRotation, HoldsABladeOnItsFlappingHinge) {
  const FlappingBlade blade;
  const formats::Scene scene = blade.read({});
  const RunReport report = simulate(scene, blade.folder.file("a.h5"), {});
  ASSERT_EQ(report.outcome, RunOutcome::completed) << report.reason;
  const formats::ResultsReader results(blade.folder.file("a.h5"));
  const double droop = results.read("joints/coordinate/flap")[0];
  // Stationary potential m g z - Ω²/2 J(β), J = m (e + r cos β)² + I₁ sin² β + I₃ cos² β, by Newton's iteration.
  double b = 0.0;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const auto slope = [](double x) {
      return 400.0 * (2.0 * (0.1 + 0.5 * std::cos(x)) * 0.5 * std::sin(x) + 0.09 * std::sin(x) * std::cos(x)) -
             2.0 * 9.81 * 0.5 * std::cos(x);
    };
    b -= slope(b) / ((slope(b + 1e-6) - slope(b - 1e-6)) / 2e-6);
  }
  EXPECT_NEAR(droop, b, 1e-9);
  EXPECT_GT(b, 0.03);
}

TEST(SceneThatCanMove, IsCalledByItsFreeJoint) {
  const auto error = [](const formats::Scene& scene) -> std::string {
    try {
      (void)inspect(scene, {});
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  const FlappingBlade blade;
  formats::Scene scene = blade.read({});
  EXPECT_EQ(error(scene), "no error");
  scene.motions.clear();  // the rotation leaves its own angle free
  EXPECT_THAT(error(scene), ::testing::HasSubstr("nothing holds coordinate 'mast'; drive it under `motions:`"));
  scene.joints.back().kind = JointKind::fixed;
  EXPECT_THAT(error(scene), ::testing::HasSubstr("nothing holds coordinate 'mast'"));
  const formats::Scene beam =
      formats::read_scene(TISSERAND_SOURCE_DIR "/examples/flexible_benchmarks/spin_up_steady.scene.yaml", {});
  EXPECT_EQ(error(beam), "no error");
  scene = beam;  // stretched by the rotation: far from equilibrium where it begins
  scene.motions.clear();
  EXPECT_THAT(error(scene), ::testing::HasSubstr("nothing holds coordinate 'root'"));
  scene = blade.read({});
  scene.statics.rotation.reset();  // its weight holds the blade
  EXPECT_EQ(error(scene), "no error");
  for (formats::BodySpec& body : scene.bodies)
    std::visit([](auto& spec) { if constexpr (requires { spec.gravity; }) spec.gravity = Eigen::Vector3d::Zero(); }, body);
  EXPECT_THAT(error(scene), ::testing::HasSubstr("nothing holds coordinate 'flap'; hold it with a joint"));
}

TEST(SceneThatCanMove, IsAnOutcomeThatNamesTheDirection) {
  Cantilever c(Eigen::Quaterniond::Identity(), {0, 1, 0});
  c.scene.joints[0] = test_support::joint("hinge", JointKind::revolute, "ground", "beam/base", {0, 0, 0}, {0, 0, 1});
  Simulation hinged(c.scene, c.files);
  StaticsReport report = solve(hinged);
  EXPECT_EQ(report.outcome, StepOutcome::singular);
  EXPECT_THAT(report.explanation, ::testing::HasSubstr("can move freely"));
  EXPECT_THAT(report.explanation,
              ::testing::AnyOf(::testing::HasSubstr("translation y"), ::testing::HasSubstr("about its z axis")));

  c.scene.joints.clear();
  Simulation free(c.scene, c.files);
  report = solve(free);
  EXPECT_EQ(report.outcome, StepOutcome::singular);
  EXPECT_THAT(report.explanation, ::testing::HasSubstr("beam/"));
}

// Gravity alone: a clamped beam of weight W hangs through by less than W L³/(8 E I) (the weight acts through the centre
// of mass of the body, two equal shares at the nodes of a Guyan element) and the clamp carries W and W L/2.
TEST(SuperelementCantilever, ClampCarriesWeightAndItsMoment) {
  Cantilever c(Eigen::Quaterniond::Identity(), {0, 0, 0});
  c.scene.gravity = {0, 0, -9.81};
  c.scene.loads.clear();
  Simulation run(c.scene, c.files);
  const StaticsReport report = solve(run);
  ASSERT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  evaluate(run.model(), run.state(), run.workspace.now);
  const JointReaction r =
      joint_reaction(run.model().joints[0], NodeMotion{}, run.workspace.now.motion[0], run.state().lambda().data());
  const double W = 9.81 * c.data.density * c.data.area * c.data.length;
  EXPECT_LT((r.force - Vector3d(0, 0, W)).norm(), 1e-8 * W);
  EXPECT_NEAR(r.moment.y() / (-W * c.data.length / 2), 1.0,
              1e-3);  // the arm shortens with the square of the deflection
}

// 1e200 N overflow: no number may come out, and no state of rest that is none.
TEST(SuperelementCantilever, OverflowIsNoEquilibrium) {
  Cantilever cantilever(Eigen::Quaterniond::Identity(), {0, 0, 1e200});
  Simulation run(cantilever.scene, cantilever.files);
  EXPECT_NE(solve(run).outcome, StepOutcome::accepted);
  EXPECT_TRUE(run.state().x().allFinite());
}

// A hinge with a torsion bar: a beam clamped at its far end is twisted about the hinge, whose angle is T L/(G J) =
// 1e-4.
TEST(SuperelementCantilever, HingeAngleIsReportedInStatics) {
  const BeamData data;
  Cantilever cantilever(Eigen::Quaterniond::Identity(), Vector3d::Zero());
  const double torque = 1e-4 * data.shear_modulus * data.J / data.length;
  cantilever.scene.joints.push_back(
      test_support::joint("hinge", JointKind::revolute, "ground", "beam/tip", {data.length, 0, 0}, {1, 0, 0}));
  cantilever.scene.loads = {test_support::constant_load("twist", LoadKind::moment, "beam/tip", {torque, 0, 0})};
  Simulation run(cantilever.scene, cantilever.files);
  ASSERT_EQ(solve(run).outcome, StepOutcome::accepted);
  EXPECT_NEAR(run.state().hinges()[0], 1e-4, 1e-10);
}

}  // namespace
}  // namespace tisserand::mechanism::statics_test

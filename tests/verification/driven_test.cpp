// SPDX-License-Identifier: GPL-3.0-or-later
// Kinematics, inverse dynamics and assembly against closed formulas and against dynamics.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "mechanism/analyses/assembly.hpp"
#include "mechanism/analyses/kinematics.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::driven_test {
namespace {

using Eigen::Vector3d;
using formats::AnalysisKind;
using formats::JointKind;
using test_support::drive;
using test_support::empty_scene;
using test_support::joint;
using test_support::rigid_body;
using test_support::Simulation;
using ::testing::HasSubstr;

const Vector3d z = Vector3d::UnitZ();

/// Moves a started simulation to `time` in steps of its integrator, with forces.
void follow(Simulation& run, double time) {
  const double h = run.scene.integrator.step;
  const long steps = std::lround((time - run.state().time()) / h);
  for (long i = 0; i < steps; ++i) {
    const double end = run.state().time() + h;
    ASSERT_EQ(move_along(run.model(), run.scene.integrator, {end, end}, run.state(), run.workspace).outcome,
              StepOutcome::accepted);
    ASSERT_TRUE(solve_multipliers(run.model(), run.state(), run.workspace));
  }
}

double drive_force(const Simulation& run, std::size_t motion) {
  for (const Coupling& coupling : run.model().couplings)
    if (coupling.motion == static_cast<int>(motion)) return -run.built.state.lambda()[coupling.row];
  return 0.0;
}

/// Crank 0.1, rod 0.3 in the x-y plane, slider along x; all hinges planar, so that rows repeat one another.
formats::Scene slider_crank(const std::string& formula) {
  formats::Scene scene = empty_scene(0.01, 1.0);
  scene.analysis = AnalysisKind::kinematics;
  scene.bodies.push_back(rigid_body("crank", 1.0, {0.05, 0, 0}, {1e-3, 1e-3, 1e-3}));
  formats::RigidBodySpec rod = rigid_body("rod", 2.0, {0.15, 0, 0}, {1e-3, 1e-2, 1e-2});
  rod.start.pose.position = {0.1, 0, 0};
  scene.bodies.push_back(rod);
  formats::RigidBodySpec slider = rigid_body("slider", 3.0, Vector3d::Zero(), {1e-3, 1e-3, 1e-3});
  slider.start.pose.position = {0.4, 0, 0};
  scene.bodies.push_back(slider);
  scene.joints.push_back(joint("crank", JointKind::revolute, "ground", "crank", Vector3d::Zero(), z));
  scene.joints.push_back(joint("pin", JointKind::revolute, "crank", "rod", {0.1, 0, 0}, z));
  scene.joints.push_back(joint("eye", JointKind::revolute, "rod", "slider", {0.4, 0, 0}, z));
  scene.joints.push_back(joint("way", JointKind::prismatic, "ground", "slider", {0.4, 0, 0}, Vector3d::UnitX()));
  scene.motions.push_back(drive("crank", formula));
  return scene;
}

// x = r cos φ + √(l² − r² sin² φ), φ = 5 t: through both dead centres, over more than a turn.
TEST(Kinematics, OfASliderCrank) {
  Simulation run(slider_crank("5 * t"), {});
  run.start();
  EXPECT_EQ(run.started.mobility.degrees_of_freedom, 0);
  require_determined(run.model(), run.started.mobility, "test", run.state(), run.workspace);
  ASSERT_TRUE(solve_rates(run.model(), run.state(), run.workspace));
  for (const double t : {0.37, 1.0, 1.5}) {
    follow(run, t);
    const double r = 0.1, l = 0.3, w = 5.0, s = std::sin(w * t), c = std::cos(w * t);
    const double q = std::sqrt(l * l - r * r * s * s), q1 = -r * r * s * c * w / q;
    const double q2 = -r * r * w * w * (c * c - s * s) / q - q1 * q1 / q;
    EXPECT_NEAR(run.position("slider").x(), r * c + q, 1e-12);
    EXPECT_NEAR(run.velocity("slider").x(), -r * w * s + q1, 1e-8);  // f'(t) by differences: 1e-10 of it
    EXPECT_NEAR(run.state().vdot()[run.model().nodes[2].translation], -r * w * w * c + q2, 1e-4);  // f'': 1e-6
    EXPECT_NEAR(run.position("slider").y(), 0.0, 1e-12);
  }
}

TEST(Kinematics, NamesWhatIsFree) {
  formats::Scene scene = slider_crank("5 * t");
  scene.motions.clear();
  Simulation run(scene, {});
  run.start();
  try {
    require_determined(run.model(), run.started.mobility, "test", run.state(), run.workspace);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("1 degrees of freedom are not driven"));
    EXPECT_THAT(error.what(), HasSubstr("coordinate '"));
  }
}

TEST(Kinematics, KnowsNoFlexibleBodies) {
  formats::Scene scene = empty_scene(0.01, 1.0);
  SuperelementFiles files;
  test_support::add_file("beam", test_support::beam_superelement({}), files);
  scene.analysis = AnalysisKind::kinematics;
  scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
  scene.joints.push_back(joint("wall", JointKind::fixed, "ground", "beam/base", Vector3d::Zero(), z));
  Simulation run(scene, files);
  run.start();
  EXPECT_THROW(require_determined(run.model(), run.started.mobility, "test", run.state(), run.workspace), Error);
}

// Crank and rod are stretched at the start: the slider's drive does not tell which way they fold.
TEST(Kinematics, StopsAtADeadPoint) {
  formats::Scene scene = slider_crank("5 * t");
  scene.motions[0].coordinate.name = "way";
  scene.motions[0].value = formats::TimeExpression{"-0.3 * t", {}, ""};
  Simulation run(scene, {});
  run.start();
  StepReport step;
  for (int i = 0; i < 200 && step.outcome == StepOutcome::accepted; ++i) {
    const std::vector<double> before = run.state().block();
    const double end = run.state().time() + 0.01;
    step = move_along(run.model(), run.scene.integrator, {end, end}, run.state(), run.workspace);
    if (step.outcome != StepOutcome::accepted) {
      EXPECT_EQ(run.state().block(), before);
    }
  }
  EXPECT_NE(step.outcome, StepOutcome::accepted);
}

// J f'' + m g a cos f, angle from the x axis.
TEST(InverseDynamics, OfAPendulum) {
  using P = test_support::Pendulum;
  formats::Scene scene = test_support::pendulum_scene(0.01, 1.0);
  scene.analysis = AnalysisKind::inverse_dynamics;
  scene.motions.push_back(drive("hinge", "0.7 * sin(3 * t)"));
  Simulation run(scene, {});
  run.start();
  ASSERT_TRUE(solve_rates(run.model(), run.state(), run.workspace));
  for (const double t : {0.2, 0.55, 0.9}) {
    follow(run, t);
    const double f = 0.7 * std::sin(3.0 * t), f2 = -9.0 * f;
    // The centre of mass is at −x: its weight turns with +m g a cos f about z.
    const double expected = P::inertia_about_hinge() * f2 - P::mass * P::gravity * P::arm * std::cos(f);
    EXPECT_NEAR(drive_force(run, 0), expected, 1e-5 * std::abs(expected));
  }
}

/// Two rods of 1 m hanging one on the other, in gravity.
formats::Scene arm(double step) {
  formats::Scene scene = empty_scene(step, 0.5);
  scene.gravity = {0, -9.81, 0};
  for (int i = 0; i < 2; ++i) {
    formats::RigidBodySpec rod = rigid_body("rod" + std::to_string(i), 2.0, {0.5, 0, 0}, {1e-3, 0.17, 0.17});
    rod.start.pose.position = {1.0 * i, 0, 0};
    scene.bodies.push_back(rod);
  }
  scene.joints.push_back(joint("shoulder", JointKind::revolute, "ground", "rod0", Vector3d::Zero(), z));
  scene.joints.push_back(joint("elbow", JointKind::revolute, "rod0", "rod1", {1, 0, 0}, z));
  return scene;
}

/// Largest distance of the hand from the prescribed motion when the moments of inverse dynamics drive it.
double forward_error(double h) {
  formats::Scene scene = arm(h);
  scene.analysis = AnalysisKind::inverse_dynamics;
  scene.motions = {drive("shoulder", "0.3 * (1 - cos(4 * t))"), drive("elbow", "0.5 * (1 - cos(6 * t))")};
  Simulation inverse(scene, {});
  inverse.start();
  EXPECT_TRUE(solve_rates(inverse.model(), inverse.state(), inverse.workspace));
  EXPECT_TRUE(solve_multipliers(inverse.model(), inverse.state(), inverse.workspace));
  formats::Scene forward_scene = arm(h);
  std::array<formats::TimeTable, 2> moment;
  const auto note = [&] {
    for (std::size_t k = 0; k < 2; ++k) {
      moment[k].time.push_back(inverse.state().time());
      moment[k].value.push_back(drive_force(inverse, k));
    }
  };
  note();
  while (inverse.state().time() < 0.5 - 0.5 * h) {
    follow(inverse, inverse.state().time() + h);
    note();
  }
  for (const char* name : {"shoulder", "elbow"}) {
    formats::SpringSpec motor;
    motor.name = std::string("motor_") + name;
    motor.coordinate = formats::CoordinateRef{name, ""};
    motor.force = moment[motor.name == "motor_elbow"];
    forward_scene.springs.push_back(motor);
  }
  forward_scene.integrator.rho = 1.0;
  Simulation forward(forward_scene, {});
  forward.start();
  forward.run(0.5);
  return (forward.position("rod1") - inverse.position("rod1")).norm();
}

// The moments are linear between their instants and the integrator is of order 2: so is what is left.
TEST(InverseDynamics, PutIntoForwardDynamicsGivesTheMotion) {
  const double coarse = forward_error(0.01), fine = forward_error(0.005);
  EXPECT_LT(fine, 2e-3);  // of 1.5 m that the hand moves
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.3);
}

// ---- assembly -------------------------------------------------------------------------------------------------------

/// Markers given on the bodies, so that poses are guesses: ground (0, 0) - crank 1 - coupler 2 - rocker 1.5 - (2, 0).
formats::Scene rough_four_bar() {
  formats::Scene scene = empty_scene(0.01, 1.0);
  scene.analysis = AnalysisKind::assembly;
  const auto link = [&scene](const std::string& name, double length, const Vector3d& at, double angle) {
    formats::RigidBodySpec body = rigid_body(name, 1.0, {0.5 * length, 0, 0}, {0.1, 0.1, 0.1});
    formats::RigidNodeSpec end;
    end.name = "end";
    end.pose.position = {length, 0, 0};
    body.nodes.push_back(end);
    body.start.pose.position = at;
    body.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d(0.1, -0.2, 1.0).normalized()));
    scene.bodies.push_back(body);
  };
  link("crank", 1.0, {0.1, 0.2, 0.1}, 1.2);
  link("coupler", 2.0, {0.8, 0.5, -0.2}, 0.5);
  link("rocker", 1.5, {2.3, -0.2, 0.0}, 2.0);
  const auto pin = [&scene](const std::string& name, const std::string& a, const std::string& b,
                            const Vector3d& ground) {
    formats::JointSpec spec;
    spec.name = name;
    spec.kind = JointKind::revolute;
    spec.a.node = a;
    spec.b.node = b;
    spec.a.orientation = spec.b.orientation = Eigen::Quaterniond::Identity();
    spec.a.position = a == "ground" ? ground : Vector3d(Vector3d::Zero());
    spec.b.position = Vector3d::Zero();
    scene.joints.push_back(spec);
  };
  pin("O", "ground", "crank", Vector3d::Zero());
  pin("A", "crank/end", "coupler", Vector3d::Zero());
  pin("B", "coupler/end", "rocker/end", Vector3d::Zero());
  pin("C", "ground", "rocker", {2, 0, 0});
  return scene;
}

AssemblyReport assembled(Simulation& run) { return assemble(run.model(), {1e-10}, run.state(), run.workspace.now); }

TEST(Assembly, ClosesAFourBarFromRoughPoses) {
  formats::Scene scene = rough_four_bar();
  scene.motions.push_back(drive("O", "1.1 + 2 * t"));
  Simulation run(scene, {});
  const AssemblyReport report = assembled(run);
  EXPECT_TRUE(report.closed) << report.gap;
  EXPECT_LT(report.velocity_gap, 1e-9);
  // Freudenstein: crank at 1.1 rad; the end of the crank and the end of the rocker are 2 apart, and the rocker 1.5
  // long.
  const Vector3d crank_end(std::cos(1.1), std::sin(1.1), 0.0);
  const Eigen::Quaterniond q = run.rotation("rocker");
  const Vector3d rocker_end = Vector3d(2, 0, 0) + q * Vector3d(1.5, 0, 0);
  EXPECT_NEAR((rocker_end - crank_end).norm(), 2.0, 1e-9);
  EXPECT_NEAR(rocker_end.z(), 0.0, 1e-9);
  EXPECT_GT((q * z).z(), 0.0);
  EXPECT_NEAR((run.rotation("crank") * run.Omega("crank")).z(), 2.0, 1e-8);
  // What it made is a start for the others.
  run.scene.analysis = AnalysisKind::kinematics;
  run.start();
  EXPECT_LT(run.started.projection.position, 1e-9);
}

TEST(Assembly, TurnsOverAnAxisThatMeetsTheWrongWay) {
  formats::Scene scene = rough_four_bar();
  auto& crank = std::get<formats::RigidBodySpec>(scene.bodies[0]);
  crank.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(3.1, Vector3d::UnitX()));
  Simulation run(scene, {});
  EXPECT_TRUE(assembled(run).closed);
  EXPECT_NEAR((run.rotation("crank") * z).z(), 1.0, 1e-9);
}

TEST(Assembly, SaysWhatStaysOpen) {
  formats::Scene scene = rough_four_bar();
  scene.joints[3].a.position = Vector3d(9, 0, 0);  // the links reach 4.5
  Simulation run(scene, {});
  const AssemblyReport report = assembled(run);
  EXPECT_FALSE(report.closed);
  ASSERT_FALSE(report.open.empty());
  EXPECT_GT(report.open.front().length, 0.5);
}

// Flexible bodies move as rigid ones: no strain comes in.
TEST(Assembly, LeavesFlexibleBodiesUndeformed) {
  formats::Scene scene = empty_scene(0.01, 1.0);
  SuperelementFiles files;
  test_support::add_file("beam", test_support::beam_superelement({}), files);
  scene.analysis = AnalysisKind::assembly;
  for (int i = 0; i < 2; ++i) {
    formats::SuperelementBodySpec body = test_support::superelement_body("b" + std::to_string(i), "beam");
    body.start.pose.position = {1.5 * i, 0.4 * i, 0.3};
    body.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.7 * i, Vector3d(1, 2, 3).normalized()));
    scene.bodies.push_back(body);
  }
  const auto weld = [&scene](const std::string& a, const std::string& b) {
    formats::JointSpec spec;
    spec.name = "weld_" + b.substr(0, 2);
    spec.kind = JointKind::fixed;
    spec.a.node = a;
    spec.b.node = b;
    spec.a.position = spec.b.position = Vector3d::Zero();
    spec.a.orientation = spec.b.orientation = Eigen::Quaterniond::Identity();
    scene.joints.push_back(spec);
  };
  weld("ground", "b0/base");
  weld("b0/tip", "b1/base");
  Simulation run(scene, files);
  EXPECT_TRUE(assembled(run).closed);
  EXPECT_NEAR((run.position("b1/tip") - Vector3d(4, 0, 0)).norm(), 0.0, 1e-9);
  EXPECT_LT(run.energy().strain, 1e-12);
}

// A rod of lumped masses and a rigid one, welded and hinged from rough poses; the angular velocity of the hinge is
// given.
TEST(Assembly, MovesModalBodiesAsRigidOnes) {
  formats::Scene scene = empty_scene(0.01, 1.0);
  BodyFiles files;
  const test_support::Rod soft{0.0, 1.0, 1e-3, 1e6, 4e5, 1e-7, 2000.0, 4};
  files.modal_bodies["rod"].body = test_support::modal_body(test_support::lumped_rod(soft), {}, 4);
  scene.analysis = AnalysisKind::assembly;
  formats::ModalBodySpec rod;
  rod.name = "rod";
  rod.file = "rod";
  rod.start.pose.position = {0.2, -0.1, 0.3};
  rod.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vector3d(1, 2, 3).normalized()));
  scene.bodies.push_back(rod);
  formats::RigidBodySpec bob = rigid_body("bob", 1.0, {0.1, 0, 0}, {0.01, 0.01, 0.01});
  bob.start.pose.position = {1.4, 0.2, 0};
  scene.bodies.push_back(bob);
  const auto join = [&scene](const std::string& name, JointKind kind, const std::string& a, const std::string& b) {
    formats::JointSpec spec;
    spec.name = name;
    spec.kind = kind;
    spec.a.node = a;
    spec.b.node = b;
    spec.a.position = spec.b.position = Vector3d::Zero();
    spec.a.orientation = spec.b.orientation = Eigen::Quaterniond::Identity();
    scene.joints.push_back(spec);
  };
  join("hinge", JointKind::revolute, "ground", "rod/n0");
  join("weld", JointKind::fixed, "rod/n4", "bob");
  scene.motions.push_back(drive("hinge", "0.3 + 2 * t"));
  Simulation run(scene, files);
  const AssemblyReport report = assembled(run);
  EXPECT_TRUE(report.closed) << report.gap;
  EXPECT_LT(report.velocity_gap, 1e-9);
  const Vector3d along(std::cos(0.3), std::sin(0.3), 0.0);
  EXPECT_LT((run.position("rod") - 0.5 * along).norm(), 1e-9);
  EXPECT_LT((run.velocity("rod") - 2.0 * z.cross(0.5 * along)).norm(), 1e-8);
  EXPECT_LT((run.position("bob") - 1.1 * along).norm(), 1e-9);
  EXPECT_LT((run.velocity("bob") - 2.0 * z.cross(1.1 * along)).norm(), 1e-8);
  EXPECT_LT(run.energy().strain, 1e-12);
}

}  // namespace
}  // namespace tisserand::mechanism::driven_test

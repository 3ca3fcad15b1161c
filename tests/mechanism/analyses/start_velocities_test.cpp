// SPDX-License-Identifier: GPL-3.0-or-later
// Free velocities at the start: what joints, drives and given velocities leave to find.
#include "mechanism/analyses/start_velocities.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/LU>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/scenes/andrews.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::start_velocities_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;
using test_support::drive;
using test_support::Simulation;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Vector3d z = Vector3d::UnitZ();

formats::InitialSpec initial(const std::string& coordinate, std::optional<double> value, std::optional<double> rate) {
  return {{coordinate, "test.yaml"}, {}, {}, value, rate, "test.yaml"};
}

CoordinateTerms coordinate(Simulation& run, const std::string& name) {
  evaluate(run.model(), run.state(), run.workspace.now);
  update_modal_nodes(run.model(), run.workspace.now);
  evaluate_coordinates(run.model(), run.state(), run.workspace.now);
  for (std::size_t i = 0; i < run.model().coordinates.size(); ++i)
    if (run.model().coordinates[i].name == name) return run.workspace.now.coordinates[i];
  ADD_FAILURE() << "no coordinate " << name;
  return {};
}

std::string start_error(const formats::Scene& scene, const BodyFiles& files) {
  try {
    Simulation run(scene, files);
    run.start();
  } catch (const Error& error) {
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

/// Plane slider-crank: crank of length r at the angle θ, rod of length l, slider on the x axis.
struct SliderCrank {
  static constexpr double r = 0.15, l = 0.4, theta = 1.0;
  double phi = std::asin(r * std::sin(theta) / l);  ///< the rod points along (cos φ, −sin φ)
  double rod_rate(double omega) const { return -r * omega * std::cos(theta) / (l * std::cos(phi)); }
  double slider_velocity(double omega) const {
    return -r * omega * (std::sin(theta) + std::cos(theta) * std::tan(phi));
  }
};

enum class Coupler { rigid, superelement, beam, modal };

const test_support::BeamData bar{SliderCrank::l, 2.1e11, 8e10, 7800, 1e-4, 8e-10, 8e-10, 1.6e-9, 0.0, 0.0, true};

struct Mechanism {
  formats::Scene scene;
  BodyFiles files;
};

/// All bodies at rest as far as the scene says: it says nothing.
Mechanism slider_crank(Coupler kind) {
  Mechanism mechanism;
  const SliderCrank geometry;
  formats::Scene& scene = mechanism.scene;
  scene = test_support::empty_scene(1e-4, 1.0);
  const Vector3d pin(SliderCrank::r * std::cos(SliderCrank::theta), SliderCrank::r * std::sin(SliderCrank::theta), 0);
  const Vector3d wrist(pin.x() + SliderCrank::l * std::cos(geometry.phi), 0, 0);
  formats::InitialMotion place;
  place.pose.position = pin;
  place.pose.orientation = Eigen::AngleAxisd(-geometry.phi, z);
  scene.bodies.push_back(test_support::body_at("crank", 0.36, 0.5 * pin, {1e-3, 1e-3, 1e-3}));
  std::string first = "rod", last = "rod";
  const double mass = bar.density * bar.area * bar.length;
  switch (kind) {
    case Coupler::rigid: {
      const double across = mass * bar.length * bar.length / 12.0 + bar.density * bar.Iz * bar.length;
      formats::RigidBodySpec rod = test_support::rigid_body(
          "rod", mass, {0.5 * bar.length, 0, 0}, {bar.density * (bar.Iy + bar.Iz) * bar.length, across, across});
      rod.start = place;
      scene.bodies.push_back(rod);
      break;
    }
    case Coupler::superelement: {
      test_support::add_file("rod", test_support::craig_bampton_beam(bar, 4), mechanism.files.superelements);
      formats::SuperelementBodySpec rod = test_support::superelement_body("rod", "rod");
      rod.start = place;
      scene.bodies.push_back(rod);
      first = "rod/base", last = "rod/tip";
      break;
    }
    case Coupler::beam: {
      formats::BeamBodySpec rod;
      rod.name = "rod";
      rod.to = {bar.length, 0, 0};
      rod.elements = 4;
      rod.section = test::rectangle(0.01, 0.01, 1.4e-9, 5.0 / 6.0);
      rod.material = test::material(2.1e11, 0.3, 7800);
      rod.start = place;
      scene.bodies.push_back(rod);
      first = "rod/start", last = "rod/end";
      break;
    }
    case Coupler::modal: {
      const test_support::Rod lumped{0.0, bar.length, 1e-4, 2.1e11, 8e10, 8e-10, 7800.0, 4};
      mechanism.files.modal_bodies["rod"].body =
          test_support::modal_body(test_support::lumped_rod(lumped), test_support::rod_conditions(4), 4);
      formats::ModalBodySpec rod = test_support::modal_spec("rod", "rod");
      rod.start = place;
      scene.bodies.push_back(rod);
      first = "rod/n0", last = "rod/n4";
      break;
    }
  }
  scene.bodies.push_back(test_support::body_at("slider", 0.08, wrist, {1e-5, 1e-5, 1e-5}));
  scene.joints = {test_support::joint("main", JointKind::revolute, "ground", "crank", {0, 0, 0}, z),
                  test_support::joint("pin", JointKind::revolute, "crank", first, pin, z),
                  test_support::joint("wrist", JointKind::spherical, last, "slider", wrist, z),
                  test_support::joint("guide", JointKind::prismatic, "ground", "slider", wrist, {1, 0, 0})};
  if (kind == Coupler::rigid) scene.joints[2].a.position = Vector3d(bar.length, 0, 0);
  return mechanism;
}

/// Analytic rates of the rigid mechanism, and no deformation: every pair of nodes of the rod keeps its distance, and
/// the kinetic energy is that of the rigid rod.
void expect_rigid_start(Simulation& run, double omega) {
  const SliderCrank geometry;
  EXPECT_NEAR(coordinate(run, "main").rate, omega, 1e-12 * std::abs(omega));
  EXPECT_NEAR(coordinate(run, "pin").rate, geometry.rod_rate(omega) - omega, 1e-11 * std::abs(omega));
  EXPECT_NEAR(coordinate(run, "guide").rate, geometry.slider_velocity(omega), 1e-11 * std::abs(omega));
  for (std::size_t i = 0; i < run.model().nodes.size(); ++i) {
    const Node& node = run.model().nodes[i];
    if (!node.name.starts_with("rod") || node.rotation < 0) continue;
    const Vector3d turn = run.rotation(node.name) * run.Omega(node.name);
    EXPECT_LT((turn - geometry.rod_rate(omega) * z).norm(), 1e-11 * std::abs(omega)) << node.name;
  }
  const int elastic = run.model().sizes.internal + run.model().sizes.modal;
  EXPECT_LT(run.state().v().tail(elastic).norm(), 1e-11 * std::abs(omega));
}

/// Moment of the drive.
double torque(Simulation& run) {
  for (const Coupling& coupling : run.model().couplings)
    if (coupling.motion >= 0) return -run.state().lambda()[coupling.row];
  ADD_FAILURE() << "no drive";
  return 0.0;
}

std::string coupler_name(const ::testing::TestParamInfo<Coupler>& coupler) {
  switch (coupler.param) {
    case Coupler::rigid:
      return "Rigid";
    case Coupler::superelement:
      return "Superelement";
    case Coupler::beam:
      return "Beam";
    case Coupler::modal:
      return "Modal";
  }
  return "";
}

class EveryCoupler : public ::testing::TestWithParam<Coupler> {};
INSTANTIATE_TEST_SUITE_P(Kinds, EveryCoupler,
                         ::testing::Values(Coupler::rigid, Coupler::superelement, Coupler::beam, Coupler::modal),
                         coupler_name);

// A drive of constant speed and bodies of which nothing is said: the coupler turns as that of the rigid linkage does.
TEST_P(EveryCoupler, FollowsADriveFromRest) {
  Mechanism mechanism = slider_crank(GetParam());
  mechanism.scene.motions.push_back(drive("main", "30 * t"));
  Simulation run(mechanism.scene, mechanism.files);
  run.start();
  expect_rigid_start(run, 30.0);
  EXPECT_THAT(run.started.velocities.derived, ElementsAre("crank", "rod", "slider"));
  EXPECT_TRUE(run.started.velocities.deforming.empty());
  EXPECT_NEAR(run.started.velocities.kinetic_energy, run.energy().kinetic, 1e-9 * run.energy().kinetic);
}

// What is written of the crank is kept to the last bit, with tolerances that would let it go.
TEST_P(EveryCoupler, LeavesTheCrankItsSpeed) {
  Mechanism mechanism = slider_crank(GetParam());
  mechanism.scene.initial_tolerance = 10.0;
  std::get<formats::RigidBodySpec>(mechanism.scene.bodies[0]).start.angular_velocity = -7.0 * z;
  Simulation run(mechanism.scene, mechanism.files);
  run.start();
  expect_rigid_start(run, -7.0);
  EXPECT_NEAR(run.Omega("crank").z(), -7.0, 1e-14);
}

TEST_P(EveryCoupler, KeepsARate) {
  Mechanism mechanism = slider_crank(GetParam());
  mechanism.scene.initial = {initial("main", {}, 2.5)};
  Simulation run(mechanism.scene, mechanism.files);
  run.start();
  expect_rigid_start(run, 2.5);
}

// A value moves all bodies rigidly: x = r cos θ + √(l² − r² sin² θ), and no strain comes in. Two turns stay two turns.
TEST_P(EveryCoupler, MovesToAValue) {
  Mechanism mechanism = slider_crank(GetParam());
  mechanism.scene.initial = {initial("main", 0.7 + 4.0 * std::numbers::pi, -3.0)};
  Simulation run(mechanism.scene, mechanism.files);
  run.start();
  EXPECT_NEAR(coordinate(run, "main").value, 0.7 + 4.0 * std::numbers::pi, 1e-11);
  EXPECT_NEAR(coordinate(run, "main").rate, -3.0, 1e-12);
  const auto reach = [](double angle) {
    return SliderCrank::r * std::cos(angle) +
           std::sqrt(SliderCrank::l * SliderCrank::l - std::pow(SliderCrank::r * std::sin(angle), 2));
  };
  EXPECT_NEAR(coordinate(run, "guide").value, reach(SliderCrank::theta + 0.7) - reach(SliderCrank::theta), 1e-11);
  EXPECT_LT(run.energy().strain, 1e-12);
  EXPECT_GT(run.started.moved, 0.05);
}

// A drive that hit the boundary nodes would show many times the torque of the rigid linkage, and leave the rod ringing.
// Elastic forces are zero at the very start and the first mode has 7 ms, so that torques are compared over 20 ms: their
// mean, which is the work, and the largest.
TEST(DriveFromRest, NeedsNoImpulse) {
  struct Torque {
    double mean = 0.0, largest = 0.0;
  };
  const auto torque_of = [](Coupler kind) {
    Mechanism mechanism = slider_crank(kind);
    mechanism.scene.motions.push_back(drive("main", "30 * t"));
    Simulation run(mechanism.scene, mechanism.files);
    run.start();
    Torque result{0.0, std::abs(torque(run))};
    run.run(0.02, [&] {
      result.mean += torque(run) / 200.0;
      result.largest = std::max(result.largest, std::abs(torque(run)));
    });
    return result;
  };
  const Torque rigid = torque_of(Coupler::rigid);
  for (const Coupler kind : {Coupler::superelement, Coupler::beam, Coupler::modal}) {
    const Torque flexible = torque_of(kind);
    EXPECT_NEAR(flexible.mean, rigid.mean, 0.1 * rigid.largest) << coupler_name({kind, 0});
    EXPECT_LT(flexible.largest, 3.0 * rigid.largest) << coupler_name({kind, 0});
  }
}

TEST(Rest, StaysRest) {
  Mechanism mechanism = slider_crank(Coupler::superelement);
  Simulation run(mechanism.scene, mechanism.files);
  const VectorXd positions = run.state().x().reshaped();
  run.start();
  EXPECT_TRUE(run.state().v().isZero(0.0));
  EXPECT_EQ(VectorXd(run.state().x().reshaped()), positions);
  EXPECT_TRUE(run.started.velocities.derived.empty());
}

// Zero that is written is given: the slider cannot stand while the crank turns.
TEST(ExplicitZero, IsGiven) {
  Mechanism mechanism = slider_crank(Coupler::superelement);
  mechanism.scene.motions.push_back(drive("main", "3 * t"));
  std::get<formats::RigidBodySpec>(mechanism.scene.bodies[0]).start.velocity = Vector3d::Zero();
  std::get<formats::RigidBodySpec>(mechanism.scene.bodies[0]).start.angular_velocity = Vector3d::Zero();
  const std::string text = start_error(mechanism.scene, mechanism.files);
  EXPECT_THAT(text, HasSubstr("initial velocities violate"));
  EXPECT_THAT(text, HasSubstr("body 'crank' differs by"));
}

TEST(Contradiction, OfARateAndADriveNamesBothAndTheGap) {
  Mechanism mechanism = slider_crank(Coupler::rigid);
  mechanism.scene.motions.push_back(drive("main", "3 * t"));
  mechanism.scene.initial = {initial("main", {}, 2.0)};
  EXPECT_THAT(start_error(mechanism.scene, mechanism.files), HasSubstr("'main' has the rate 3, not 2"));
}

TEST(Contradiction, OfDrivesIsTheirs) {
  Mechanism mechanism = slider_crank(Coupler::rigid);
  mechanism.scene.motions = {drive("main", "3 * t"), drive("guide", "0.5 * t")};
  mechanism.scene.motions[1].name = "other";
  EXPECT_THAT(start_error(mechanism.scene, mechanism.files), HasSubstr("joints and drives contradict each other"));
}

TEST(Contradiction, OfValuesNamesWhatStaysOpen) {
  Mechanism mechanism = slider_crank(Coupler::rigid);
  mechanism.scene.initial = {initial("guide", 2.0, {})};  // the slider reaches r + l = 0.55
  EXPECT_THAT(start_error(mechanism.scene, mechanism.files), HasSubstr("the bodies cannot reach the initial values"));
}

TEST(UnknownCoordinate, IsAnError) {
  Mechanism mechanism = slider_crank(Coupler::rigid);
  mechanism.scene.initial = {initial("wrist", {}, 1.0)};
  EXPECT_THAT(start_error(mechanism.scene, mechanism.files), HasSubstr("no joint coordinate 'wrist'"));
}

// Least ½ Σ (m |v|² + J ω²) of two free plane bodies in a hinge that opens at a rate of 2, solved as a dense system
// with multipliers. Nothing from outside acts: momentum and moment of momentum come out zero.
TEST(LeastEnergy, OfTwoFreeBodiesInAHinge) {
  const double m[] = {1.0, 3.0}, J[] = {0.2, 0.5}, rate = 2.0;
  const Vector3d center[] = {{0.1, 0.3, 0.0}, {1.2, -0.2, 0.0}}, pin(0.6, 0.4, 0.0);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.push_back(test_support::body_at("a", m[0], center[0], {0.3, 0.3, J[0]}));
  scene.bodies.push_back(test_support::body_at("b", m[1], center[1], {0.6, 0.6, J[1]}));
  scene.joints.push_back(test_support::joint("elbow", JointKind::revolute, "a", "b", pin, z));
  scene.initial = {initial("elbow", {}, rate)};
  Simulation run(scene, {});
  run.start();

  // Unknowns v_a (x, y), ω_a, v_b, ω_b, then multipliers of: the pins move together, ω_b − ω_a = rate.
  MatrixXd A = MatrixXd::Zero(9, 9);
  VectorXd right = VectorXd::Zero(9);
  for (int i = 0; i < 2; ++i) {
    const Vector3d arm = pin - center[i];
    const double sign = i == 0 ? -1.0 : 1.0;
    A.diagonal().segment<3>(3 * i) << m[i], m[i], J[i];
    A.block<1, 3>(6, 3 * i) << sign, 0.0, -sign * arm.y();
    A.block<1, 3>(7, 3 * i) << 0.0, sign, sign * arm.x();
    A(8, 3 * i + 2) = sign;
  }
  A.topRightCorner<6, 3>() = A.bottomLeftCorner<3, 6>().transpose();
  right[8] = rate;
  const VectorXd expected = A.fullPivLu().solve(right);
  Vector3d momentum = Vector3d::Zero(), spin = Vector3d::Zero();
  for (int i = 0; i < 2; ++i) {
    const std::string name = i == 0 ? "a" : "b";
    const Vector3d v = run.velocity(name), omega = run.Omega(name);
    EXPECT_LT((v - Vector3d(expected[3 * i], expected[3 * i + 1], 0)).norm(), 1e-12);
    EXPECT_LT((omega - Vector3d(0, 0, expected[3 * i + 2])).norm(), 1e-12);
    momentum += m[i] * v;
    spin += m[i] * center[i].cross(v) + Vector3d(0, 0, J[i] * omega.z());
  }
  EXPECT_LT(momentum.norm(), 1e-12);
  EXPECT_LT(spin.norm(), 1e-12);
}

// A body of which one velocity is written has the other as near to zero as joints let it: a thrown hammer does not
// spin, and a crank whose part frame is away from its hinge needs no velocity.
TEST(HalfGiven, IsZeroUnlessJointsAskForMore) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  formats::RigidBodySpec hammer = test_support::rigid_body("hammer", 2.0, {0.4, 0, 0}, {0.1, 0.2, 0.2});
  hammer.start.velocity = Vector3d(1, 2, 3);
  formats::RigidBodySpec crank = test_support::body_at("crank", 1.0, {0.5, 0, 0}, {0.1, 0.1, 0.1});
  crank.start.angular_velocity = 4.0 * z;
  scene.bodies = {hammer, crank};
  scene.joints = {test_support::joint("hinge", JointKind::revolute, "ground", "crank", {0, 0, 0}, z)};
  Simulation run(scene, {});
  run.start();
  EXPECT_EQ(run.velocity("hammer"), Vector3d(1, 2, 3));
  EXPECT_TRUE(run.Omega("hammer").isZero(0.0));
  EXPECT_LT((run.velocity("crank") - Vector3d(0, 2, 0)).norm(), 1e-13);
  EXPECT_THAT(run.started.velocities.derived, ElementsAre("crank"));
}

// A cantilever whose tip is driven across: no rigid motion serves. Expected: min over v and w of (v − R w)ᵀ M (v − R w)
// with v = 0 at the base, v_x = 0 and v_y = 0.3 at the tip, from the matrices of the element as a dense system.
TEST(Deformation, IsTheSmallestStrainRateInTheMassMetric) {
  const test_support::BeamData data;
  const formats::Superelement element = test_support::craig_bampton_beam(data, 3);
  SuperelementFiles files;
  test_support::add_file("beam", element, files);
  formats::Scene scene = test_support::empty_scene(1e-5, 1.0);
  scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
  scene.bodies.push_back(test_support::body_at("bystander", 1.0, {0, 3, 0}, {1, 1, 1}));
  scene.joints = {test_support::joint("wall", JointKind::fixed, "ground", "beam/base", {0, 0, 0}, z),
                  test_support::joint("tip", JointKind::generic, "ground", "beam/tip", {data.length, 0, 0}, z)};
  scene.joints[1].x_axis = Vector3d::UnitX();
  scene.joints[1].hold = {true, false, false, false, false, false};
  scene.motions.push_back(drive("tip/y", "0.3 * t"));
  Simulation run(scene, files);
  run.start();
  EXPECT_THAT(run.started.velocities.deforming, ElementsAre("beam"));
  EXPECT_THAT(run.started.velocities.derived, ElementsAre("beam"));

  const int n = 15;  // base, tip, three internal coordinates
  MatrixXd R = MatrixXd::Zero(n, 6), C = MatrixXd::Zero(8, n);
  R.topRows<6>().setIdentity();
  R.middleRows<6>(6).setIdentity();
  R.block<3, 3>(6, 3) = -skew<double>(Vector3d(data.length, 0, 0));
  C.leftCols<8>().setIdentity();  // base, and x and y of the tip
  const MatrixXd MR = element.mass * R;
  const MatrixXd P = element.mass - MR * (R.transpose() * MR).inverse() * MR.transpose();
  MatrixXd A = MatrixXd::Zero(n + 8, n + 8);
  A.topLeftCorner(n, n) = P;
  A.topRightCorner(n, 8) = C.transpose();
  A.bottomLeftCorner(8, n) = C;
  VectorXd right = VectorXd::Zero(n + 8);
  right[n + 7] = 0.3;
  const VectorXd expected = A.fullPivLu().solve(right).head(n);
  VectorXd v(n);
  v << run.velocity("beam/base"), run.Omega("beam/base"), run.velocity("beam/tip"), run.Omega("beam/tip"),
      run.state().v().tail(3);
  EXPECT_LT((v - expected).norm(), 1e-9 * expected.norm()) << v.transpose() << "\n" << expected.transpose();
  EXPECT_GT(expected.tail(3).norm(), 1e-6);
}

// After statics at rest the drives move everything, whatever the bodies were given; after a motion nothing changes.
TEST(OtherAnalysis, GivesVelocitiesUnlessItEndedAtRest) {
  Mechanism mechanism = slider_crank(Coupler::superelement);
  mechanism.scene.motions.push_back(drive("main", "3 * t"));
  Simulation run(mechanism.scene, mechanism.files);
  (void)start(run.scene, StartFrom::rest, run.built, run.workspace);
  expect_rigid_start(run, 3.0);
  const VectorXd v = run.state().v();
  (void)start(run.scene, StartFrom::motion, run.built, run.workspace);
  EXPECT_LT((run.state().v() - v).norm(), 1e-13 * v.norm());
}

// `initial` gives the velocities of a body, of the poses and of an analysis at rest alike; what hangs on it follows
// with the least energy: of a bob on a ball the same velocity at the ball, and no turn where its centre of mass is
// there.
TEST(InitialBody, KeepsItsVelocitiesAlsoAfterAnAnalysisAtRest) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  formats::RigidBodySpec frame = test_support::rigid_body("frame", 2.0, {0.1, 0, 0}, {1, 1, 1});
  formats::RigidBodySpec bob = test_support::rigid_body("bob", 1.0, {0, 0, 0}, {1, 1, 1});
  bob.start.pose.position = {0, 2, 0};
  scene.bodies = {frame, bob};
  scene.joints.push_back(test_support::joint("ball", JointKind::spherical, "frame", "bob", {0, 2, 0}, z));
  formats::InitialSpec entry;
  entry.coordinate.name = "frame";
  entry.velocity = Vector3d(1, 2, 3);
  entry.angular_velocity = Vector3d(0, 0, 2);
  scene.initial.push_back(entry);
  for (const StartFrom from : {StartFrom::poses, StartFrom::rest}) {
    Simulation run(scene, {});
    (void)start(run.scene, from, run.built, run.workspace);
    EXPECT_LT((run.velocity("frame") - Vector3d(1, 2.2, 3)).norm(), 1e-12);  // of its centre of mass
    EXPECT_LT((run.Omega("frame") - Vector3d(0, 0, 2)).norm(), 1e-12);
    EXPECT_LT((run.velocity("bob") - Vector3d(-3, 2, 3)).norm(), 1e-9);
    EXPECT_LT(run.Omega("bob").norm(), 1e-9);
  }
  scene.bodies = {frame};
  scene.joints.clear();
  Simulation alone(scene, {});
  (void)start(alone.scene, StartFrom::rest, alone.built, alone.workspace);
  EXPECT_LT((alone.velocity("frame") - Vector3d(1, 2.2, 3)).norm(), 1e-14);
}

TEST(VirtualBody, FollowsAndMustNotBeGivenOtherVelocities) {
  for (const formats::VirtualBodies way : {formats::VirtualBodies::keep, formats::VirtualBodies::eliminate}) {
    formats::Scene scene = test_support::pendulum_scene(1e-3, 1.0);
    scene.virtual_bodies = way;
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = 2.0 * z;
    const std::string body = std::get<formats::RigidBodySpec>(scene.bodies[0]).name;
    formats::VirtualBodySpec place;
    place.name = "place";
    place.start.pose.position = {0.3, 0.1, 0};
    scene.bodies.emplace_back(place);
    formats::JointSpec tie;
    tie.name = "tie";
    tie.kind = JointKind::fixed;
    tie.a.node = body;
    tie.b.node = "place";
    scene.joints.push_back(tie);
    Simulation run(scene, {});
    run.start();
    if (way == formats::VirtualBodies::keep) {
      EXPECT_LT((run.velocity("place") - Vector3d(-0.2, 0.6, 0)).norm(), 1e-12);
    }
    std::get<formats::VirtualBodySpec>(scene.bodies[1]).start.velocity = Vector3d(1, 0, 0);
    EXPECT_THAT(start_error(scene, {}), HasSubstr("'place'"));
  }
}

}  // namespace
}  // namespace tisserand::mechanism::start_velocities_test

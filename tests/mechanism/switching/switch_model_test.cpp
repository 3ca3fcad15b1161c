// Switches of models: momenta, what is not touched, deformations that bodies begin with.
#include "mechanism/switching/switch_model.hpp"

#include <gtest/gtest.h>

#include "mechanism/build/effects.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/switching/buckling.hpp"
#include "mechanism/switching/carried_inertia.hpp"
#include "mechanism/switching/compliance.hpp"
#include "mechanism/switching/rigid_projection.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"

namespace tisserand::mechanism::switch_model_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;
using test_support::Simulation;

const test_support::BeamData beam_data;

BodyFiles files() {
  BodyFiles list;
  test_support::add_file("beam", test_support::craig_bampton_beam(beam_data, 3), list.superelements);
  return list;
}

/// Two beams on a ball joint with a load at their end, thrown and turning, and a block that flies alone.
formats::Scene thrown(bool held) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  for (const char* name : {"left", "right"}) {
    formats::SuperelementBodySpec beam = test_support::superelement_body(name, "beam");
    beam.start.pose.position = {name == std::string("left") ? 0.0 : 2.0, 0, 0};
    beam.start.velocity = held ? Vector3d(0, 0, 0) : Vector3d(3, 2, 1);
    beam.start.angular_velocity = Vector3d(0, 0, 1.5);
    if (name == std::string("right")) beam.start.velocity = *beam.start.velocity + Vector3d(0, 3, 0);  // 1.5 x 2
    scene.bodies.emplace_back(beam);
  }
  formats::RigidBodySpec block = test_support::rigid_body("block", 2.0, {0.1, 0, 0}, {0.1, 0.2, 0.3});
  block.start.pose.position = {0, 5, 0};
  block.start.velocity = Vector3d(0.3, 0.2, 0.1);
  block.start.angular_velocity = Vector3d(1, 2, 3);
  scene.bodies.emplace_back(block);
  scene.joints = {test_support::joint("ball", JointKind::spherical, "left/tip", "right/base", {2, 0, 0}, {0, 0, 1})};
  if (held)
    scene.joints.push_back(
        test_support::joint("hinge", JointKind::revolute, "ground", "left/base", {0, 0, 0}, {0, 0, 1}));
  scene.loads = {test_support::constant_load("pull", formats::LoadKind::force, "right/tip", {5, 30, 20})};
  return scene;
}

formats::Scene with_flexibility(const formats::Scene& scene, const std::string& body, bool on) {
  return *with_effects_switched(with_switches(scene, {{formats::Effect::flexibility, body, on}}), files());
}

/// Sums over all bodies: of superelements their mass matrix times the rates in axes of the frame, so independent of
/// momentum_of(), which takes differences of energies.
Momentum sum_of_momenta(const Model& model, const State& state) {
  Evaluation now(model);
  evaluate(model, state, now);
  Momentum sum = Momentum::Zero();
  for (const RigidBody& body : model.rigid_bodies) {
    const NodeMotion& node = now.motion[body.node];
    sum.head<3>() += body.mass * node.xd;
    sum.tail<3>() += node.x.cross(body.mass * node.xd) + node.R * (body.inertia * node.Omega);
  }
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const LocalMotion<double>& motion = now.superelements[i].motion;
    const VectorXd p = body.M_BB * motion.rate_B + body.M_BI * motion.rate_I;
    for (std::size_t j = 0; j < body.node.size(); ++j) {
      const NodeMotion& node = now.motion[model.superelements[i].nodes[j]];
      const Vector3d linear = motion.R0 * p.segment<3>(body.node[j].translation_row);
      sum.head<3>() += linear;
      sum.tail<3>() += node.x.cross(linear) + node.R * p.segment<3>(body.node[j].rotation_row);
    }
  }
  return sum;
}

/// Bent and vibrating, after some steps with the load.
State bent(Simulation& run) {
  run.start();
  run.run(0.05);
  return run.state();
}

struct Switches {
  SwitchedModel rigid, back;
};

Switches forth_and_back(const formats::Scene& scene, const Model& model, const State& state,
                        const Deformations& deformations) {
  auto rigid = switch_model(with_flexibility(scene, "right", false), files(), {model, state}, {"right"}, {});
  EXPECT_TRUE(rigid.has_value());
  auto back = switch_model(with_flexibility(scene, "right", true), files(), {rigid->built.model, rigid->built.state},
                           {"right"}, deformations);
  EXPECT_TRUE(back.has_value());
  return {std::move(*rigid), std::move(*back)};
}

// No ground, so nothing may change. The tolerance is round-off: 1e-12 of the momentum.
TEST(SwitchModel, KeepsLinearAndAngularMomentumForthAndBack) {
  const formats::Scene scene = thrown(false);
  Simulation run(scene, files());
  const State state = bent(run);
  const Momentum before = sum_of_momenta(run.model(), state);
  const SuperelementCompliance compliance(body_of(run.model(), 1));
  VectorXd load = VectorXd::Zero(15);
  load[5] = -200.0;
  load[11] = 200.0;
  const Switches after = forth_and_back(
      scene, run.model(), state, {{"right", {compliance.deformation(load), 30.0 * compliance.deformation(load)}}});
  const Momentum rigid = sum_of_momenta(after.rigid.built.model, after.rigid.built.state);
  const Momentum back = sum_of_momenta(after.back.built.model, after.back.built.state);
  EXPECT_LT((rigid - before).head<3>().norm(), 1e-12 * before.head<3>().norm());
  EXPECT_LT((rigid - before).tail<3>().norm(), 1e-12 * before.tail<3>().norm());
  EXPECT_LT((back - before).head<3>().norm(), 1e-12 * before.head<3>().norm());
  EXPECT_LT((back - before).tail<3>().norm(), 1e-12 * before.tail<3>().norm());
  EXPECT_GT((rigid - before).norm(), 0.0);  // and they were computed anew
}

/// What a clamped beam shows under a force across its tip, turned by `angle` at the clamp.
VectorXd bent_by(double angle, const SuperelementBody& body) {
  VectorXd load = VectorXd::Zero(body.boundary_size + body.modes);
  load[body.node.back().translation_row + 1] = 1.0;
  load[body.node.front().translation_row + 1] = -1.0;
  load[body.node.front().rotation_row + 2] = -2.0;  // its length
  const VectorXd y = SuperelementCompliance(body).deformation(load);
  return angle / std::abs(y[body.node.front().rotation_row + 2]) * y;
}

// A cantilever of second order bent by 1e-3 rad: its place on the clamp neither stretches it (half the square of that
// angle would, by as much as a tenth of its bending energy) nor lets it vibrate: deformation and rate are as asked.
TEST(SwitchModel, MovesBentBodiesAsRigidOnes) {
  BodyFiles list;
  test_support::add_file("beam", test_support::craig_bampton_beam({}, 3), list.superelements);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  const Vector3d z = Vector3d::UnitZ();
  scene.joints = {
      test_support::joint("hinge", formats::JointKind::revolute, "ground", "beam/base", Vector3d::Zero(), z)};
  scene.motions = {test_support::drive("hinge", "3 * t")};
  const formats::Scene rigid = with_flexibility(scene, "beam", false);
  Simulation run(rigid, list);
  run.start();
  run.run(0.05);
  Simulation whole(scene, list);
  const SuperelementBody& body = body_of(whole.model(), 0);
  const SuperelementCompliance compliance(body);
  const VectorXd y = bent_by(1e-3, body);
  const auto after = switch_model(scene, list, {run.model(), run.state()}, {"beam"}, {{"beam", {y, 20.0 * y}}});
  ASSERT_TRUE(after.has_value());
  Evaluation now(after->built.model);
  evaluate(after->built.model, after->built.state, now);
  EXPECT_LT(now.constraint.norm(), 1e-12);
  EXPECT_LT(now.constraint_rate.norm(), 1e-12);
  const Deformation is = deformation_of(after->built.model, 0, now);
  const auto strain = [&](const VectorXd& of) { return compliance.strain_energy(compliance.without_rigid_motion(of)); };
  ASSERT_GT(strain(y), 0.0);
  EXPECT_LT(strain(is.y - y), 1e-8 * strain(y));
  EXPECT_LT(strain(is.rate - 20.0 * y), 1e-8 * 400.0 * strain(y));
}

/// A parallelogram of rigid links with a beam on its coupler, in the pose where all links lie on one line: an equation
/// repeats others there that it does not repeat elsewhere.
formats::Scene stretched_parallelogram() {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  const Vector3d z = Vector3d::UnitZ();
  const auto link = [&scene](const std::string& name, double x, double length, double speed, double omega) {
    formats::RigidBodySpec body = test_support::rigid_body(name, 3.0, {0.5 * length, 0, 0}, {0.1, 0.5, 0.5});
    body.start.pose.position = {x, 0, 0};
    body.start.velocity = {0, speed, 0};
    body.start.angular_velocity = {0, 0, omega};
    scene.bodies.emplace_back(body);
  };
  link("left", 0, 1, 0, 2);
  link("coupler", 1, 3, 2, 0);
  link("right", 3, 1, 0, 2);
  formats::SuperelementBodySpec beam = test_support::superelement_body("beam", "beam");
  beam.start.pose.position = {2, 0, 0};
  beam.start.velocity = {0, 2, 0};
  scene.bodies.emplace_back(beam);
  const auto add = [&](const std::string& name, JointKind kind, const std::string& a, const std::string& b, double x) {
    scene.joints.push_back(test_support::joint(name, kind, a, b, {x, 0, 0}, z));
  };
  add("a", JointKind::revolute, "ground", "left", 0);
  add("b", JointKind::revolute, "left", "coupler", 1);
  add("c", JointKind::revolute, "coupler", "right", 4);
  add("d", JointKind::revolute, "ground", "right", 3);
  add("weld", JointKind::fixed, "coupler", "beam/base", 2);
  return scene;
}

// Equations that repeat others at the start are not left out where they no longer do.
TEST(SwitchModel, WakesBentWhereOtherEquationsRepeatThanAtTheStart) {
  const formats::Scene scene = stretched_parallelogram();
  Simulation run(with_flexibility(scene, "beam", false), files());
  run.start();
  run.run(0.2);
  Simulation whole(scene, files());
  const SuperelementBody& body = body_of(whole.model(), 0);
  const VectorXd y = bent_by(0.01, body);
  const auto after =
      switch_model(scene, files(), {run.model(), run.state()}, {"beam"}, {{"beam", {y, VectorXd::Zero(y.size())}}});
  ASSERT_TRUE(after.has_value());
  Evaluation now(after->built.model);
  evaluate(after->built.model, after->built.state, now);
  EXPECT_LT(now.constraint.norm(), 1e-9);
  const SuperelementCompliance compliance(body);
  const auto strain = [&](const VectorXd& of) { return compliance.strain_energy(compliance.without_rigid_motion(of)); };
  EXPECT_LT(strain(deformation_of(after->built.model, 0, now).y - y), 1e-6 * strain(y));
}

// Two bodies in a ball joint of which one moves at 1: they share it as their masses ask, m1 v/(m1 + m2), though a
// spring holds the first to the ground: the stiffness of the scene is no weight.
TEST(RigidProjection, SharesGapsByMassesAlone) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies = {test_support::rigid_body("a", 1.0, Vector3d::Zero(), {1, 1, 1}),
                  test_support::rigid_body("b", 3.0, Vector3d::Zero(), {1, 1, 1})};
  scene.joints = {test_support::joint("ball", JointKind::spherical, "a", "b", Vector3d::Zero(), Vector3d::UnitZ())};
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.a = {"ground", Vector3d(-1, 0, 0), std::nullopt, "test"};
  spring.b = {"a", Vector3d::Zero(), std::nullopt, "test"};
  spring.stiffness = 1e4;
  scene.springs = {spring};
  Simulation run(scene, {});
  run.start();
  State state = run.state();
  Evaluation now(run.model());
  state.v().setZero();
  state.v()[run.model().nodes[run.model().rigid_bodies[0].node].translation] = 1.0;
  RigidProjection(run.model(), 1.0).velocities(state, now);
  for (const RigidBody& body : run.model().rigid_bodies)
    EXPECT_NEAR(state.v()[run.model().nodes[body.node].translation], 0.25, 1e-8);  // the least weight
}

// The block is another group: no number of it changes.
TEST(SwitchModel, TouchesNoOtherBody) {
  const formats::Scene scene = thrown(false);
  Simulation run(scene, files());
  const State state = bent(run);
  const Switches after = forth_and_back(scene, run.model(), state, {});
  const auto block = [](const Model& model, const State& of) {
    Evaluation now(model);
    evaluate(model, of, now);
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
      if (model.nodes[i].name == "block") return now.motion[i];
    return NodeMotion{};
  };
  const NodeMotion was = block(run.model(), state);
  ASSERT_GT(was.x.norm(), 1.0);
  for (const BuiltModel* built : {&after.rigid.built, &after.back.built}) {
    const NodeMotion is = block(built->model, built->state);
    EXPECT_EQ(is.x, was.x);
    EXPECT_EQ(is.R, was.R);
    EXPECT_EQ(is.xd, was.xd);
    EXPECT_EQ(is.Omega, was.Omega);
  }
}

// A chain on a hinge about z can turn about it alone: there the moment of momentum stays, whatever the hinge gives.
TEST(SwitchModel, KeepsTheMomentumThatGroundLeavesFree) {
  const formats::Scene scene = thrown(true);
  Simulation run(scene, files());
  const State state = bent(run);
  const Switches after = forth_and_back(scene, run.model(), state, {});
  const auto about_hinge = [](const Model& model, const State& of) {
    Evaluation now(model);
    return momentum_of(model, of, {"left", "right"}, Vector3d::Zero(), now)[5];
  };
  const double before = about_hinge(run.model(), state);
  ASSERT_GT(std::abs(before), 1.0);
  EXPECT_NEAR(about_hinge(after.rigid.built.model, after.rigid.built.state), before, 1e-12 * std::abs(before));
  EXPECT_NEAR(about_hinge(after.back.built.model, after.back.built.state), before, 1e-12 * std::abs(before));
}

// Without deformation rigid to flexible and back is the same motion to round-off, and costs no energy.
TEST(SwitchModel, RigidToFlexibleAndBackReturnsTheMotion) {
  formats::Scene scene = thrown(false);
  scene.loads.clear();
  const formats::Scene rigid = with_flexibility(scene, "right", false);
  Simulation run(rigid, files());
  run.start();
  run.run(0.02);
  const auto flexible =
      switch_model(with_flexibility(scene, "right", true), files(), {run.model(), run.state()}, {"right"}, {});
  ASSERT_TRUE(flexible.has_value());
  const auto back = switch_model(rigid, files(), {flexible->built.model, flexible->built.state}, {"right"}, {});
  ASSERT_TRUE(back.has_value());
  EXPECT_LT((back->built.state.x() - run.state().x()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((back->built.state.Q() - run.state().Q()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((back->built.state.v() - run.state().v()).cwiseAbs().maxCoeff(), 1e-9);
  const auto same = switch_model(rigid, files(), {run.model(), run.state()}, {}, {});  // accelerations solved for anew
  ASSERT_TRUE(same.has_value());
  ASSERT_GT(same->built.state.lambda().norm(), 1.0);
  EXPECT_LT((back->built.state.lambda() - same->built.state.lambda()).norm(), 1e-9 * same->built.state.lambda().norm());
  EXPECT_LT(std::abs(flexible->energy), 1e-9 * run.energy().kinetic);
}

// A free beam under a moment M at both ends: w'' = M/EI, its ends are M L²/(12 EI) from the mean of its mass, and
// turned by M L/EI against each other. Hermite's cubic holds the parabola, its mass the mean; rotary inertia is left
// out.
TEST(Compliance, IsThatOfABeam) {
  test_support::BeamData data;
  data.rotary_inertia = false;
  BodyFiles list;
  test_support::add_file("beam", test_support::beam_superelement(data), list.superelements);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  const BuiltModel built = build_model(scene, list);
  const SuperelementCompliance compliance(body_of(built.model, 0));
  const double M = 100.0, L = data.length, EI = data.young * data.Iz;
  VectorXd load = VectorXd::Zero(12);
  load[5] = -M;
  load[11] = M;
  const VectorXd y = compliance.deformation(load);
  EXPECT_NEAR(y[11] - y[5], M * L / EI, 1e-9 * M * L / EI);
  EXPECT_NEAR(std::abs(y[1]), M * L * L / (12.0 * EI), 1e-9 * M * L * L / EI);
  EXPECT_NEAR(compliance.strain_energy(y), 0.5 * M * M * L / EI, 1e-9 * M * M * L / EI);
  EXPECT_LT((compliance.without_rigid_motion(y) - y).norm(), 1e-12 * y.norm());
}

/// A straight beam of 2 with EI = 100 about its weaker axis, elastic as it is.
SuperelementBody slender() {
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(1e5), 2.0, 8);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  const BodyFiles list = test_support::files_of(test_support::second_order_beam(beam, {0, 4, 8}, 6));
  return build_model(scene, list).model.superelement_bodies[0];
}

// Euler's load of hinged ends, π² EI/l²; a beam of eight elements errs by less than 1e-3. Tension buckles nothing.
TEST(Buckling, IsEulersLoad) {
  const SuperelementBody body = slender();
  const SuperelementCompliance compliance(body);
  const Buckling buckling(body, compliance);
  const double euler = EIGEN_PI * EIGEN_PI * 100.0 / 4.0;
  VectorXd load = VectorXd::Zero(body.boundary_size + body.modes);
  load[0] = 0.3 * euler;
  load[12] = -0.3 * euler;
  EXPECT_NEAR(buckling.load_share(compliance.deformation(load)), 0.3, 0.3 * 5e-3);
  EXPECT_GE(buckling.bound(compliance.deformation(load)), 0.3 * (1.0 - 5e-3));
  EXPECT_LT(buckling.load_share(compliance.deformation(-load)), 1e-3);
}

// A beam that bends on a clamp: with y and its rigid motion taken apart, T must be that of the motion with the clamp at
// rest. A bob at the tip adds ½ m v².
TEST(CarriedInertia, IsThatOfTheClampedBeamAndItsBob) {
  BodyFiles list;
  test_support::add_file("beam", test_support::craig_bampton_beam({}, 3), list.superelements);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  formats::RigidBodySpec bob = test_support::rigid_body("bob", 5.0, Vector3d::Zero(), {1e-9, 1e-9, 1e-9});
  bob.start.pose.position = {2, 0, 0};
  scene.bodies.emplace_back(bob);
  const Vector3d z = Vector3d::UnitZ();
  scene.joints = {test_support::joint("clamp", formats::JointKind::fixed, "ground", "beam/base", Vector3d::Zero(), z),
                  test_support::joint("ball", formats::JointKind::spherical, "beam/tip", "bob", {2, 0, 0}, z)};
  Simulation whole(scene, list);
  whole.start();
  scene.effects = {{formats::Effect::flexibility, "", false, "test"}};
  Simulation rigid(scene, list);
  rigid.start();
  const SuperelementBody& body = body_of(whole.model(), 0);
  const SuperelementCompliance compliance(body);
  // As a cantilever: the base rests.
  VectorXd rate = VectorXd::Zero(body.boundary_size + body.modes);
  const int tip = body.node.back().translation_row;
  rate[tip + 1] = 0.7;
  rate[body.node.back().rotation_row + 2] = 0.5;
  const double expected = compliance.kinetic_energy(rate) + 0.5 * 5.0 * 0.7 * 0.7;
  const VectorXd y = compliance.without_rigid_motion(rate);
  CarriedInertia carried(rigid.model(), whole.model());
  carried.set(rigid.state(), 1e-9);
  Evaluation now(whole.model());
  evaluate(whole.model(), whole.state(), now);
  EXPECT_LT(compliance.kinetic_energy(y), 0.5 * expected);
  EXPECT_TRUE(carried.knows());
  EXPECT_NEAR(compliance.kinetic_energy(y) + carried.energies({y}, now)[0], expected, 1e-6 * expected);

  // Multipliers of other joints say nothing of these.
  scene.joints.pop_back();
  Simulation other(scene, list);
  other.start();
  CarriedInertia unknown(other.model(), whole.model());
  unknown.set(other.state(), 1e-9);
  EXPECT_FALSE(unknown.knows());
  EXPECT_EQ(unknown.energies({y}, now)[0], 0.0);
}

}  // namespace
}  // namespace tisserand::mechanism::switch_model_test

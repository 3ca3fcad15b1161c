// SPDX-License-Identifier: GPL-3.0-or-later
// Modal bodies: what they yield to loads, what joints move along with them, momenta of one that loses its modes.
#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/switching/carried_inertia.hpp"
#include "mechanism/switching/modal_compliance.hpp"
#include "mechanism/switching/transfer.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::modal_compliance_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;
using test_support::Simulation;

const Vector3d z = Vector3d::UnitZ();
const test_support::Rod rod{0.0, 2.0, 4.0e-4, 2.1e11, 8.0e10, 1.5e-8, 7800.0, 8};

/// The rod with all of its 48 modes, in two frames: hinged at its ends, and that of the mean of its mass.
BodyFiles files() {
  BodyFiles list;
  const test_support::LumpedModel model = test_support::lumped_rod(rod);
  list.modal_bodies["hinged"].body = test_support::modal_body(model, test_support::rod_conditions(8), 48);
  list.modal_bodies["mean"].body = test_support::modal_body(model, {}, 48);
  return list;
}

/// Clamped at n0, with a bob of 5 on a ball joint at n8.
formats::Scene cantilever(const std::string& file) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.push_back(test_support::modal_spec("rod", file));
  formats::RigidBodySpec bob = test_support::rigid_body("bob", 5.0, Vector3d::Zero(), {1e-9, 1e-9, 1e-9});
  bob.start.pose.position = {2, 0, 0};
  scene.bodies.emplace_back(bob);
  scene.joints = {test_support::joint("clamp", JointKind::fixed, "ground", "rod/n0", Vector3d::Zero(), z),
                  test_support::joint("ball", JointKind::spherical, "rod/n8", "bob", {2, 0, 0}, z)};
  return scene;
}

const ModalNode& node_of(const Model& model, const std::string& name) {
  for (const ModalNode& node : model.modal_nodes)
    if (node.name == name) return node;
  throw std::runtime_error("no node " + name);
}

formats::Scene with_flexibility(const formats::Scene& scene, const std::string& body, bool on) {
  return *with_effects_switched(with_switches(scene, {{formats::Effect::flexibility, body, on}}), files());
}

/// A force F along y at the tip, which a clamp bears: it bends the rod by F L³/(3 EI), seen from there.
struct BentRod {
  BuiltModel built;
  VectorXd y;
  explicit BentRod(const std::string& file) : built(build_model(cantilever(file), files())) {
    const ModalNode &tip = node_of(built.model, "n8"), &base = node_of(built.model, "n0");
    const VectorXd along = (tip.Xd - base.Xd).row(1), turning = base.Xt.row(2);
    VectorXd load = VectorXd::Zero(6 + along.size());
    load.tail(along.size()) = along - rod.length * turning;
    y = ModalCompliance(built.model, 0).deformation(load);
  }
};

// Elements of Bernoulli hold the cubic; with all modes nothing is missing but round-off, whatever the frame.
TEST(ModalCompliance, IsThatOfTheCantileverInAnyFrame) {
  const double bend = rod.length * rod.length * rod.length / (3.0 * rod.E * rod.I);
  const BentRod hinged("hinged"), mean("mean");
  const ModalCompliance a(hinged.built.model, 0), b(mean.built.model, 0);
  EXPECT_NEAR(a.displacement(hinged.y), bend, 1e-7 * bend);
  EXPECT_NEAR(b.displacement(mean.y), bend, 1e-7 * bend);
  EXPECT_NEAR(a.strain_energy(hinged.y), 0.5 * bend, 1e-7 * bend);
  EXPECT_NEAR(b.strain_energy(mean.y), 0.5 * bend, 1e-7 * bend);
  EXPECT_NEAR(a.kinetic_energy(hinged.y), b.kinetic_energy(mean.y), 1e-9 * b.kinetic_energy(mean.y));
  EXPECT_LT(mean.y.head<6>().norm(), 1e-9 * mean.y.norm());  // that frame stays
  EXPECT_GT(hinged.y.head<6>().norm(), 1e-6 * hinged.y.norm());
  EXPECT_LT((a.without_rigid_motion(hinged.y) - hinged.y).norm(), 1e-12 * hinged.y.norm());
}

// Accelerations like the bend of a cantilever, seen from its clamp: forces are not below what their bound by Cauchy and
// Schwarz allows, the sum of |ÿ| by the masses of the nodes, and not many times as much. A body that deforms by y and
// vibrates with ω² = V/T as seen from there needs them at that frequency.
TEST(ModalCompliance, ForcesAreThoseOfTheMassAsSeenFromTheClamp) {
  for (const char* file : {"hinged", "mean"}) {
    const BentRod bent(file);
    const ModalCompliance compliance(bent.built.model, 0);
    const VectorXd w = bent.y.tail(bent.y.size() - 6);
    const ModalNode& base = node_of(bent.built.model, "n0");
    const Vector3d turn = -(base.Xt * w), move = -(base.Xd * w) - turn.cross(base.x);
    const test_support::LumpedModel lumped = test_support::lumped_rod(rod);
    double sum = 0.0, square = 0.0;
    for (Eigen::Index k = 0; k < lumped.nodes(); ++k) {
      const ModalNode& node = node_of(bent.built.model, "n" + std::to_string(k));
      const Vector3d u = move + turn.cross(node.x) + node.Xd * w;
      sum += lumped.mass[k] * u.norm();
      square += lumped.mass[k] * u.squaredNorm();
    }
    const double inertia = compliance.force(bent.y) * square / (2.0 * compliance.strain_energy(bent.y));
    EXPECT_GE(inertia, sum);
    EXPECT_LE(inertia, 2.0 * sum);
  }
}

// T of the bent rod without rigid motion, and what clamp and bob add, is that of the motion with the clamp at rest.
TEST(ModalCompliance, CarriesClampAndBob) {
  for (const char* file : {"hinged", "mean"}) {
    const formats::Scene scene = cantilever(file);
    Simulation whole(scene, files());
    whole.start();
    Simulation rigid(with_flexibility(scene, "rod", false), files());
    rigid.start();
    const ModalCompliance compliance(whole.model(), 0);
    const ModalNode &base = node_of(whole.model(), "n0"), &tip = node_of(whole.model(), "n8");
    VectorXd rate = BentRod(file).y;
    const VectorXd w = rate.tail(rate.size() - 6);
    rate.segment<3>(3) = -(base.Xt * w);
    rate.head<3>() = -(base.Xd * w) - Vector3d(rate.segment<3>(3)).cross(base.x);
    const Vector3d v = rate.head<3>() + Vector3d(rate.segment<3>(3)).cross(tip.x) + tip.Xd * w;
    const double expected = compliance.kinetic_energy(rate) + 0.5 * 5.0 * v.squaredNorm();
    const VectorXd y = compliance.without_rigid_motion(rate);
    CarriedInertia carried(rigid.model(), whole.model());
    carried.set(rigid.state(), 1e-9);
    Evaluation now(whole.model());
    evaluate(whole.model(), whole.state(), now);
    EXPECT_LT(compliance.kinetic_energy(y), 0.5 * expected);
    EXPECT_NEAR(compliance.kinetic_energy(y) + carried.energies({y}, now)[0], expected, 1e-6 * expected);
  }
}

using Momenta = Eigen::Matrix<double, 6, 1>;

/// [linear; angular about the origin] by the mass matrices of the bodies.
Momenta sum_of_momenta(const Model& model, const State& state) {
  Evaluation now(model);
  evaluate(model, state, now);
  Momenta sum = Momenta::Zero();
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    const NodeMotion& frame = now.motion[body.node];
    tangent(body, {1, 0, 0}, now.modal_bodies[i]);
    VectorXd v(6 + body.modes);
    v << frame.xd, frame.Omega, now.modal_bodies[i].wd;
    const VectorXd p = now.modal_bodies[i].tangent * v;
    sum.head<3>() += p.head<3>();
    sum.tail<3>() += frame.x.cross(Vector3d(p.head<3>())) + frame.R * p.segment<3>(3);
  }
  return sum;
}

// A body that loses its modes in flight alone moves on as one with the mass and the momenta that it had, about any
// point: so its place is that of its mass too, and how fast it flies does not turn it.
TEST(StateTransfer, ModalBodyWithoutModesKeepsMassAndMomenta) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  formats::ModalBodySpec thrown = test_support::modal_spec("left", "hinged");
  thrown.start.angular_velocity = Vector3d(0, 0, 1.5);
  scene.bodies.push_back(thrown);
  std::vector<Vector3d> spin;
  for (const double speed : {3.0, 300.0}) {
    std::get<formats::ModalBodySpec>(scene.bodies[0]).start.velocity = Vector3d(speed, 2.0, 1.0);
    Simulation run(scene, files());
    run.start();
    State state = run.state();
    const ModalBody& body = run.model().modal_bodies[0];
    const VectorXd w = BentRod("hinged").y.tail(body.modes);
    state.w() = 1e-2 * w / w.cwiseAbs().maxCoeff();
    state.v().segment(run.model().sizes.first_modal() + body.offset, body.modes) = 100.0 * state.w();
    const Momenta before = sum_of_momenta(run.model(), state);
    const BuiltModel rigid = build_model(with_flexibility(scene, "left", false), files());
    const State after = transfer(run.model(), state, rigid.model);
    EXPECT_LT((sum_of_momenta(rigid.model, after) - before).norm(), 1e-12 * before.norm());
    EXPECT_GT((after.x() - state.x()).norm(), 1e-5);
    EXPECT_GT((after.v().head<6>() - state.v().head<6>()).norm(), 1e-3);
    spin.emplace_back(after.v().segment<3>(3));
  }
  EXPECT_LT((spin[0] - spin[1]).norm(), 1e-10 * spin[0].norm());
}

}  // namespace
}  // namespace tisserand::mechanism::modal_compliance_test

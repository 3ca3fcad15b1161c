// SPDX-License-Identifier: GPL-3.0-or-later
// Superelements in motion: rigid motion, conservation, order of nodes, damping, gravity, the rigid use.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::superelement_motion_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using formats::InertiaOption;
using test_support::BeamData;
using test_support::Simulation;

double order(double coarse, double fine) { return std::log2(coarse / fine); }

/// A beam with a thick section, equal in both bending planes; strains of (rate · length)²/E = 1e-8 when it spins.
BeamData stiff_symmetric_beam() {
  BeamData beam;
  beam.young = 4.0e8;
  beam.shear_modulus = 1.6e8;
  beam.density = 1.0;
  beam.area = 1.0;
  beam.Iy = beam.Iz = 0.3;
  beam.J = 0.5;
  return beam;
}

formats::Scene free_beam(double step, double end, InertiaOption inertia) {
  formats::Scene scene = test_support::empty_scene(step, end);
  formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
  body.inertia = inertia;
  scene.bodies.push_back(body);
  scene.integrator.rho = 1.0;
  return scene;
}

SuperelementFiles one_file(const formats::Superelement& element) {
  SuperelementFiles files;
  test_support::add_file("beam", element, files);
  return files;
}

/// Angular momentum about the world's origin: rows of M v are the momenta of nodes, forces in world and moments in node
/// axes.
Vector3d angular_momentum(Simulation& run) {
  evaluate(run.model(), run.state(), run.workspace.now);
  const SuperelementBody& body = body_of(run.model(), 0);
  const NodeView<NodeMotion> nodes = nodes_of(run.model(), 0, run.workspace.now);
  Eigen::MatrixXd M;
  test_support::uncondensed_tangent(body, run.workspace.now.superelements[0], nodes, Vector3d::Zero(), {1, 0, 0},
                                    TangentKind::step, M);
  const Eigen::VectorXd p = M * Eigen::VectorXd(run.state().v());
  Vector3d sum = Vector3d::Zero();
  for (std::size_t j = 0; j < body.node.size(); ++j) {
    const NodeMotion& node = nodes[j];
    sum += node.x.cross(p.segment<3>(body.node[j].translation_row)) + node.R * p.segment<3>(body.node[j].rotation_row);
  }
  return sum;
}

// Symmetric top without forces: the axis turns about the fixed angular momentum H at |H|/J_t. J_a = ρ(Iy + Iz)L = 1.2,
// J_t = ρAL³/12 + ρIL = 8/12 + 0.6.
class FreeTop : public ::testing::TestWithParam<InertiaOption> {};
INSTANTIATE_TEST_SUITE_P(Options, FreeTop, ::testing::Values(InertiaOption::A, InertiaOption::B, InertiaOption::M),
                         [](const ::testing::TestParamInfo<InertiaOption>& given) {
                           return std::string(1, "ABM"[static_cast<int>(given.param)]);
                         });

TEST_P(FreeTop, OfASuperelementConvergesToTheAnalyticMotionWithOrderTwo) {
  const double J_a = 1.2, J_t = 8.0 / 12.0 + 0.6;
  const Vector3d Omega(2.0, 1.0, 0.0), velocity(0.3, -0.1, 0.2), H(J_a * Omega.x(), J_t * Omega.y(), 0.0);
  const auto error = [&](double h) {
    formats::Scene scene = free_beam(h, 2.0, GetParam());
    auto& start = std::get<formats::SuperelementBodySpec>(scene.bodies[0]).start;
    start.angular_velocity = Omega;
    start.velocity = velocity - Omega.cross(Vector3d(1, 0, 0));  // centre of mass with `velocity`
    Simulation run(scene, one_file(test_support::beam_superelement(stiff_symmetric_beam())));
    run.start();
    double worst = 0.0;
    run.run(2.0, [&] {
      const double t = run.state().time();
      const Vector3d axis = exp_so3<double>(Vector3d(t * H / J_t)) * Vector3d::UnitX();
      const Vector3d tip = Vector3d(1, 0, 0) + t * velocity + axis;
      worst = std::max(worst, (run.position("beam/tip") - tip).norm());
    });
    return worst;
  };
  const double coarse = error(0.02), fine = error(0.01);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(order(coarse, fine), 2.0, 0.1) << coarse << " " << fine;
}

// 10 000 steps of the free top (E = 4e5: strains of 1e-5, highest frequency times step 10): errors of energy and
// angular momentum in the last tenth are not above those of the first tenth by more than half.
TEST_P(FreeTop, EnergyAndMomentumErrorsStayBoundedOverTenThousandSteps) {
  const double h = 0.01;
  formats::Scene scene = free_beam(h, 10000 * h, GetParam());
  auto& start = std::get<formats::SuperelementBodySpec>(scene.bodies[0]).start;
  start.angular_velocity = {2.0, 1.0, 0.0};
  start.velocity = -start.angular_velocity->cross(Vector3d(1, 0, 0));
  BeamData beam = stiff_symmetric_beam();
  beam.young = 4.0e5;
  beam.shear_modulus = 1.6e5;
  Simulation run(scene, one_file(test_support::beam_superelement(beam)));
  run.start();
  const double energy = run.state().initial_energy();
  const Vector3d momentum = angular_momentum(run);
  EXPECT_LT((momentum - Vector3d(2.4, 8.0 / 12.0 + 0.6, 0)).norm(), 1e-9);
  std::array<double, 10> energy_error{}, momentum_error{};
  run.run(10000 * h, [&] {
    const auto tenth = static_cast<std::size_t>(std::min(9L, (run.steps - 1) / 1000));
    if (run.steps % 3 != 0) return;
    momentum_error[tenth] =
        std::max(momentum_error[tenth], (angular_momentum(run) - momentum).norm() / momentum.norm());
    energy_error[tenth] =
        std::max(energy_error[tenth], std::abs(evaluate_energy(run.model(), run.workspace.now).total() / energy - 1.0));
  });
  EXPECT_LT(energy_error[0], 1e-3);
  EXPECT_LT(momentum_error[0], 1e-3);
  EXPECT_LT(energy_error[9], 1.5 * energy_error[0]);
  EXPECT_LT(momentum_error[9], 1.5 * momentum_error[0]);
}

// Rows and nodes of the file in another order, 500 steps of a flexible pendulum in space.
TEST(OrderOfNodes, DoesNotMatter) {
  const formats::Superelement element = test_support::test_superelement("frame");
  std::vector<int> rows(static_cast<std::size_t>(element.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<int>((7 * i + 3) % rows.size());
  const formats::Superelement other = test_support::permute_rows(test_support::permute_nodes(element, {2, 0, 1}), rows);
  std::array<Vector3d, 2> tip;
  for (int i = 0; i < 2; ++i) {
    formats::Scene scene = test_support::empty_scene(2e-3, 1.0);
    scene.gravity = {0, 0, -2.0};  // of a soft frame
    scene.bodies.push_back(test_support::superelement_body("frame", "beam"));
    scene.joints.push_back(test_support::joint("pivot", formats::JointKind::spherical, "ground", "frame/n0",
                                               Vector3d::Zero(), Vector3d::UnitZ()));
    Simulation run(scene, one_file(i == 0 ? element : other));
    run.start();
    run.run(1.0);
    ASSERT_EQ(run.steps, 500);
    tip[i] = run.position("frame/n5");
  }
  EXPECT_GT((tip[0] - Vector3d(1.5, 1, 0.7)).norm(), 0.5);
  EXPECT_LT((tip[0] - tip[1]).norm(), 1e-9);
}

// A spin about the beam's axis, which strains nothing, with strong damping of all kinds: nothing is dissipated. Without
// internal modes also in translation; with them options A and B are exact for rigid motion only where no node moves
// across the axis of spin, since ẏ_I is not covariant.
TEST(Damping, LeavesRigidMotionAlone) {
  for (const int modes : {0, 4}) {
    const Vector3d velocity = modes == 0 ? Vector3d(1, 2, 3) : Vector3d(1, 0, 0);
    formats::Scene scene = free_beam(0.01, 2.0, InertiaOption::B);
    auto& body = std::get<formats::SuperelementBodySpec>(scene.bodies[0]);
    body.damping = {.mass = 50.0, .stiffness = 1.0, .ratio = 0.5, .ratios = {}};
    body.damping.ratio_internal = 0.5;
    body.start.velocity = velocity;
    body.start.angular_velocity = {4, 0, 0};
    Simulation run(scene, one_file(test_support::craig_bampton_beam(stiff_symmetric_beam(), modes)));
    run.start();
    run.run(2.0);
    EXPECT_LT((run.velocity("beam/tip") - velocity).norm(), 1e-10);
    EXPECT_LT((run.Omega("beam/tip") - Vector3d(4, 0, 0)).norm(), 1e-10);
    EXPECT_LT(std::abs(run.state().dissipated()), 1e-12 * run.state().initial_energy());
  }
}

// What vibration loses is what the damping dissipates; the balance falls with order 2 at least.
TEST(Damping, DissipatedEnergyClosesTheBalance) {
  const auto balance = [](double h) {
    formats::Scene scene = free_beam(h, 1.0, InertiaOption::B);
    auto& body = std::get<formats::SuperelementBodySpec>(scene.bodies[0]);
    body.damping.stiffness = 2e-3;
    body.start.angular_velocity = {0, 0, 3};
    Simulation run(scene, one_file(test_support::craig_bampton_beam(test_support::soft_beam(), 4)));
    run.start();
    run.run(1.0);
    EXPECT_GT(run.state().dissipated(), 1e-4);
    return (run.energy().total() - run.state().initial_energy() + run.state().dissipated()) / run.state().dissipated();
  };
  const double coarse = balance(2e-3), fine = balance(1e-3);
  EXPECT_LT(std::abs(fine), 0.02);
  EXPECT_GT(order(std::abs(coarse), std::abs(fine)), 1.7) << coarse << " " << fine;
}

// The potential of gravity acts on the centre of mass alone: free fall does not deform the body and is integrated
// exactly.
TEST(Gravity, FreeFallIsExact) {
  formats::Scene scene = free_beam(0.01, 1.0, InertiaOption::A);
  scene.gravity = {1.0, -2.0, -9.81};
  auto& body = std::get<formats::SuperelementBodySpec>(scene.bodies[0]);
  body.start.velocity = {0, 3, 4};
  body.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  Simulation run(scene, one_file(test_support::craig_bampton_beam(test_support::soft_beam(), 4)));
  run.start();
  const Vector3d base = run.position("beam/base"), tip = run.position("beam/tip");
  run.run(1.0);
  const Vector3d fall = Vector3d(0, 3, 4) + 0.5 * scene.gravity;
  EXPECT_LT((run.position("beam/base") - base - fall).norm(), 1e-10);
  EXPECT_LT((run.position("beam/tip") - tip - fall).norm(), 1e-10);
  EXPECT_LT(run.state().y().cwiseAbs().maxCoeff(), 1e-10);
}

/// Tip of a beam that falls from the horizontal on a hinge about y.
Vector3d pendulum_tip(const formats::BodySpec& body, const SuperelementFiles& files, double step) {
  const std::string tip = "beam/tip", base = "beam/base";
  formats::Scene scene = test_support::empty_scene(step, 1.0);
  scene.gravity = {0, 0, -9.81};
  scene.bodies.push_back(body);
  scene.joints.push_back(
      test_support::joint("hinge", formats::JointKind::revolute, "ground", base, Vector3d::Zero(), {0, 1, 0}));
  Simulation run(scene, files);
  run.start();
  run.run(1.0);
  for (const Place& place : run.model().places)
    if (place.name == tip) {
      NodeMotion node;
      node.x = run.state().x().col(place.marker.node);
      const Eigen::Vector4d q = run.state().Q().col(place.marker.node);
      node.R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
      return marker_position(place.marker, node);
    }
  ADD_FAILURE() << tip;
  return Vector3d::Zero();
}

// The `rigid` use of a file is the rigid body of the same mass properties. A stiff superelement (deflection m g L³/(8 E
// I) = 2e-7) has nodes of its own and so another error of the integrator, of order 2: extrapolated it vanishes.
TEST(Gravity, StiffAndRigidUseOfASuperelementSwingLikeARigidBody) {
  const SuperelementFiles files = one_file(test_support::beam_superelement(stiff_symmetric_beam()));
  formats::SuperelementBodySpec flexible = test_support::superelement_body("beam", "beam"), rigid = flexible;
  rigid.rigid = true;
  formats::RigidBodySpec body =
      test_support::rigid_body("beam", 2.0, {1, 0, 0}, {1.2, 8.0 / 12.0 + 0.6, 8.0 / 12.0 + 0.6});
  body.nodes = {{"base", {}}, {"tip", {.position = {2, 0, 0}, .orientation = Eigen::Quaterniond::Identity()}}};
  const Vector3d coarse = pendulum_tip(body, {}, 0.005), fine = pendulum_tip(body, {}, 0.0025);
  EXPECT_LT(fine.z(), -1.0);
  EXPECT_LT((pendulum_tip(rigid, files, 0.005) - coarse).norm(), 1e-11);
  const Vector3d difference = pendulum_tip(flexible, files, 0.005) - coarse;
  const Vector3d finer = pendulum_tip(flexible, files, 0.0025) - fine;
  EXPECT_LT(finer.norm(), 1e-4);
  EXPECT_LT((4.0 / 3.0 * finer - 1.0 / 3.0 * difference).norm(), 2e-6);
}

}  // namespace
}  // namespace tisserand::mechanism::superelement_motion_test

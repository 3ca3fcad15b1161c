// SPDX-License-Identifier: GPL-3.0-or-later
// Bushings and fields: wrench from the potential, tangents by differences, invariance, and motions with known answers.
#include "mechanism/forces/bushing.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/forces/relative_turn.hpp"
#include "tests/support/scenes/model_tangent.hpp"

namespace tisserand::mechanism::bushing_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test_support::random_vector;
using test_support::random_vector_n;

NodeMotion random_motion(std::mt19937& random) {
  NodeMotion motion;
  motion.x = random_vector(random, 1.0);
  motion.R = exp_so3<double>(random_vector(random, 0.8));
  motion.xd = random_vector(random, 1.0);
  motion.Omega = random_vector(random, 1.0);
  return motion;
}

struct Pair {
  Bushing bushing;
  NodeMotion a, b;
  double wound = 0.0;  ///< angle near which turns are counted

  /// With seeds of 4 and more, turns about axis seed % 3 are counted, and the bodies are wound up by some.
  explicit Pair(unsigned seed) {
    std::mt19937 random(seed);
    if (seed >= 4) bushing.axis = static_cast<int>(seed % 3);
    bushing.a = {0, random_vector(random, 1.0), exp_so3<double>(random_vector(random, 0.5))};
    bushing.b = {1, random_vector(random, 1.0), exp_so3<double>(random_vector(random, 0.5))};
    const Matrix6d any = Matrix6d::Random();
    bushing.stiffness = any + any.transpose();
    bushing.damping = any * any.transpose();
    bushing.free = random_vector_n(random, 6, 0.5);
    bushing.preload = random_vector_n(random, 6, 1.0);
    a = random_motion(random);
    b = random_motion(random);
    if (bushing.axis < 0) return;
    wound = 2.0 * seed;
    const Vector3d axis = bushing.b.R.col(bushing.axis);  // in axes of the node
    b.R = (b.R * exp_so3<double>(Vector3d(wound * axis))).eval();
  }
  MarkerPair markers() const { return {bushing.a, bushing.b, a, b}; }
  BushingTerms terms() const {
    BushingTerms terms;
    evaluate(bushing, markers(), wound, terms);
    return terms;
  }
  Vector12d velocity() const {
    Vector12d v;
    v << a.xd, a.Omega, b.xd, b.Omega;
    return v;
  }
  Pair moved(const Vector12d& d) const {
    Pair p = *this;
    p.a.x += d.segment<3>(0);
    p.a.R = (a.R * exp_so3<double>(Vector3d(d.segment<3>(3)))).eval();
    p.b.x += d.segment<3>(6);
    p.b.R = (b.R * exp_so3<double>(Vector3d(d.segment<3>(9)))).eval();
    return p;
  }
  Pair faster(const Vector12d& d) const {
    Pair p = *this;
    p.a.xd += d.segment<3>(0);
    p.a.Omega += d.segment<3>(3);
    p.b.xd += d.segment<3>(6);
    p.b.Omega += d.segment<3>(9);
    return p;
  }
};

// Central differences with 1e-5 of functions of size ten: truncation and round-off below 1e-8.
constexpr double h = 1e-5, accuracy = 1e-7;

TEST(Bushing, ForceIsTheGradientOfItsEnergy) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    Pair pair(seed);
    pair.bushing.damping.setZero();
    const Vector12d force = pair.terms().force;
    for (int j = 0; j < 12; ++j) {
      const Vector12d d = h * Vector12d::Unit(j);
      EXPECT_NEAR(force[j], (pair.moved(d).terms().energy - pair.moved(-d).terms().energy) / (2 * h), accuracy);
    }
  }
}

TEST(Bushing, TangentIsTheDerivativeOfTheForce) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Pair pair(seed);
    Square12 K, C;
    const BushingTerms terms = pair.terms();
    tangent(pair.bushing, pair.markers(), terms, {0, 0, 1}, K);
    tangent(pair.bushing, pair.markers(), terms, {0, 1, 0}, C);
    for (int j = 0; j < 12; ++j) {
      const Vector12d d = h * Vector12d::Unit(j);
      const Vector12d by_position = (pair.moved(d).terms().force - pair.moved(-d).terms().force) / (2 * h);
      const Vector12d by_velocity = (pair.faster(d).terms().force - pair.faster(-d).terms().force) / (2 * h);
      EXPECT_LT((K.col(j) - by_position).cwiseAbs().maxCoeff(), accuracy) << j;
      EXPECT_LT((C.col(j) - by_velocity).cwiseAbs().maxCoeff(), accuracy) << j;
    }
  }
}

// Power of what acts on the bodies: −(rate of the energy) − dissipated + supplied, also for fields that are not
// symmetric; and the rate of the deflection is J v.
TEST(Bushing, PowerIsAccountedFor) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    Pair pair(seed);
    pair.bushing.stiffness(0, 4) += 0.7;
    const BushingTerms terms = pair.terms();
    const Vector12d v = pair.velocity();
    const Pair ahead = pair.moved(h * v), behind = pair.moved(-h * v);
    const Vector6d rate = (ahead.terms().deflection - behind.terms().deflection) / (2 * h);
    EXPECT_LT((terms.J * v - rate).norm(), accuracy);
    const double energy_rate = (ahead.terms().energy - behind.terms().energy) / (2 * h);
    EXPECT_NEAR(-terms.force.dot(v), -energy_rate - terms.dissipated + terms.supplied, accuracy);
    EXPECT_GE(terms.dissipated, 0.0);
    EXPECT_NE(terms.supplied, 0.0);
  }
}

// The same rigid motion of both bodies changes no deflection and turns the forces with them.
TEST(Bushing, IsInvariantUnderRigidMotion) {
  const Pair pair(3);
  Pair turned = pair;
  const Matrix3d R = exp_so3<double>(Vector3d(1.0, -2.0, 0.5));
  const Vector3d shift(3, -1, 2), omega(0.3, 0.2, -0.9);
  for (NodeMotion* node : {&turned.a, &turned.b}) {
    node->x = R * node->x + shift;
    node->R = (R * node->R).eval();
    node->xd = R * node->xd + omega.cross(node->x - shift);
    node->Omega += node->R.transpose() * omega;
  }
  const BushingTerms before = pair.terms(), after = turned.terms();
  EXPECT_LT((before.deflection - after.deflection).norm(), 1e-13);
  EXPECT_LT((before.w - after.w).norm(), 1e-12);
  EXPECT_LT((R * before.force.segment<3>(6) - after.force.segment<3>(6)).norm(), 1e-12);
  EXPECT_LT((before.force.segment<3>(9) - after.force.segment<3>(9)).norm(), 1e-12);
}

// With isotropic stiffnesses (k in all translations, c in all rotations) the energy ½k|p|² + ½c|ψ|² does not know which
// body is called a: the forces on the bodies are the same.
TEST(Bushing, IsotropicOnesMayBeSwapped) {
  for (const unsigned seed : {3u, 4u, 5u, 6u}) {
    Pair pair(seed), swapped(seed);
    for (Pair* p : {&pair, &swapped}) {
      p->bushing.stiffness.setZero();
      p->bushing.stiffness.diagonal() << 5, 5, 5, 3, 3, 3;
      p->bushing.damping.setZero();
      p->bushing.free.setZero();
      p->bushing.preload.setZero();
    }
    std::swap(swapped.bushing.a, swapped.bushing.b);
    std::swap(swapped.a, swapped.b);
    swapped.wound = -pair.wound;
    const Vector12d f = pair.terms().force, g = swapped.terms().force;
    EXPECT_LT((f.head<6>() - g.tail<6>()).norm(), 1e-12) << seed;
    EXPECT_LT((f.tail<6>() - g.head<6>()).norm(), 1e-12) << seed;
  }
}

formats::Scene mounted_body(double step, double end) {
  formats::Scene scene = test_support::empty_scene(step, end);
  scene.bodies.push_back(test_support::rigid_body("body", 2.0, {0.3, 0.1, -0.2}, {0.3, 0.4, 0.5}));
  formats::BushingSpec mount;
  mount.name = "mount";
  mount.a.node = "ground";
  mount.b.node = "body";
  scene.bushings.push_back(mount);
  return scene;
}

// A field K between ground and a body at rest under a preload: equilibrium where K d = preload, whatever the size.
TEST(Bushing, EquilibriumUnderAPreload) {
  formats::Scene scene = mounted_body(0.01, 1.0);
  scene.analysis = formats::AnalysisKind::statics;
  const Matrix6d any = Matrix6d::Random();
  const Matrix6d K = any * any.transpose() + 2.0 * Matrix6d::Identity();
  Vector6d d;
  d << 0.2, -0.3, 0.1, 0.5, -0.4, 0.3;
  scene.bushings[0].stiffness = K;
  scene.bushings[0].preload = K * d;
  test_support::Simulation run(scene, {});
  run.start();
  const StaticsReport report = solve_statics(run.model(), scene.statics, {}, run.state(), run.workspace);
  ASSERT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  EXPECT_LT((run.workspace.now.bushings[0].deflection - d).norm(), 1e-8);
}

// Torsion about a principal axis through the centre of mass: θ'' = −(c θ + d θ')/J, amplitude 2.5 rad: linear at any
// size, since d is the angle itself. Damped vibration from θ₀ at rest, analytic; error of the integrator O(h²).
TEST(Bushing, LargeTurnsVibrateHarmonically) {
  const double J = 0.5, c = 8.0, d = 0.2, theta0 = 2.5;
  const auto error = [&](double step) {
    formats::Scene scene = test_support::empty_scene(step, 2.0);
    formats::RigidBodySpec body = test_support::rigid_body("body", 2.0, Vector3d::Zero(), {0.3, 0.4, J});
    body.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(theta0, Vector3d::UnitZ()));
    scene.bodies.push_back(body);
    formats::BushingSpec mount;
    mount.name = "mount";
    mount.a.node = "ground";
    mount.b.node = "body";
    mount.b.orientation = Eigen::Quaterniond::Identity();  // the axes of the body, not those of the start
    mount.a.orientation = Eigen::Quaterniond::Identity();
    mount.stiffness.diagonal() << 10, 10, 10, c, c, c;
    mount.damping.diagonal() << 0, 0, 0, d, d, d;
    mount.free = Vector6d::Zero();
    scene.bushings.push_back(mount);
    test_support::Simulation run(scene, {});
    run.start();
    run.run(2.0);
    const double delta = 0.5 * d / J, omega = std::sqrt(c / J - delta * delta);
    const double expected =
        theta0 * std::exp(-delta * 2.0) * (std::cos(2.0 * omega) + delta / omega * std::sin(2.0 * omega));
    evaluate(run.model(), run.state(), run.workspace.now);
    return std::abs(run.workspace.now.bushings[0].deflection[5] - expected);
  };
  const double coarse = error(0.01), fine = error(0.005);
  EXPECT_LT(fine, 2e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
}

// Symmetric swing and twist: R = exp(τ/2 e) exp(σ) exp(τ/2 e), over several turns.
TEST(Bushing, SwingAndTwistComposeTheRotation) {
  for (int axis = 0; axis < 3; ++axis)
    for (double twist = -14.0; twist < 14.0; twist += 0.7)
      for (const double swing : {0.0, 1e-9, 0.05, 0.21, 1.3, 2.8}) {
        Vector3d sigma(0.6, -0.3, 0.4);
        sigma[axis] = 0.0;
        sigma *= swing / sigma.norm();
        const Matrix3d half = exp_so3<double>(Vector3d(0.5 * twist * Vector3d::Unit(axis)));
        const RelativeTurn turn(half * exp_so3<double>(sigma) * half, axis, twist + 1.0);
        EXPECT_LT((turn.psi() - sigma - twist * Vector3d::Unit(axis)).norm(), 1e-13)
            << axis << ' ' << twist << ' ' << swing;
      }
}

// A body thrown about in a field with damping in space: the balance of energy is of second order in the step.
TEST(Bushing, EnergyIsBalanced) {
  const auto balance = [](double step) {
    formats::Scene scene = mounted_body(step, 0.5);
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = {1, 2, -1};
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = {2, -3, 4};
    scene.integrator.rho = 1.0;
    Matrix6d K = Vector6d(60, 40, 50, 9, 8, 10).asDiagonal();
    K(0, 4) = K(4, 0) = 3.0;
    K(1, 2) = 5.0;  // not symmetric: some of its power is work
    scene.bushings[0].stiffness = K;
    scene.bushings[0].damping = Vector6d(1, 2, 3, 0.1, 0.2, 0.1).asDiagonal();
    test_support::Simulation run(scene, {});
    run.start();
    run.run(0.5);
    EXPECT_GT(run.state().dissipated(), 1.0);
    return run.energy().total() - run.state().initial_energy() - run.state().work() + run.state().dissipated();
  };
  const double coarse = balance(0.004), fine = balance(0.002);
  EXPECT_LT(std::abs(fine), 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.8);
}

}  // namespace
}  // namespace tisserand::mechanism::bushing_test

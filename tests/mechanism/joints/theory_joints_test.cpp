// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas (55) to (61) of docs/THEORY.md, written down once more as they stand there and compared with what the
// program computes: relations, their gradients, the equations of motion, friction.
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "common/math/rotation.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/joints/friction.hpp"
#include "tests/support/bodies/theory_motion.hpp"
#include "tests/support/scenes/model_tangent.hpp"

namespace tisserand::mechanism::theory_joints_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using test_support::random_vector;

/// Two nodes with markers away from them, at random places and rates.
struct Places {
  NodeMotion node[2];
  Marker marker[2];

  explicit Places(unsigned seed) {
    std::mt19937 random(seed);
    for (int i = 0; i < 2; ++i) {
      node[i].x = random_vector(random, 2.0);
      node[i].R = exp_so3<double>(random_vector(random, 1.0));
      node[i].xd = random_vector(random, 1.0);
      node[i].Omega = random_vector(random, 1.0);
      marker[i] = {i, random_vector(random, 1.0), exp_so3<double>(random_vector(random, 1.0))};
    }
  }
  MarkerPair pair() const { return {marker[0], marker[1], node[0], node[1]}; }
  Vector3d axis(int body, int k) const { return node[body].R * marker[body].R.col(k); }
  Vector3d arm(int body) const { return node[body].R * marker[body].p; }
  Vector3d d() const { return node[1].x + arm(1) - node[0].x - arm(0); }
};

/// A row of B from how a value changes with δx and with θ = R δΘ of both nodes.
Row12 row(const Places& at, const Vector3d& x_A, const Vector3d& theta_A, const Vector3d& x_B,
          const Vector3d& theta_B) {
  Row12 out;
  out << x_A.transpose(), theta_A.transpose() * at.node[0].R, x_B.transpose(), theta_B.transpose() * at.node[1].R;
  return out;
}

/// Value and row of a product a·b of axes: (55), (56).
struct Product {
  double value;
  Row12 G;
};
Product product(const Places& at, int i, int j) {
  const Vector3d a = at.axis(0, i), b = at.axis(1, j), by = a.cross(b), none = Vector3d::Zero();
  return {a.dot(b), row(at, none, by, none, -by)};  // (56)
}

void expect_relation(const Relation& relation, const Places& at, double value, const Row12& G) {
  const RelationTerms terms = evaluate(relation, at.pair());
  EXPECT_NEAR(terms.value, value, 1e-14);
  EXPECT_LT((terms.G - G).norm(), 1e-13);
}

// (55) to (57)
TEST(TheoryJoints, RelationsAndGradients) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Places at(seed);
    const Vector3d d = at.d(), n = d.normalized(), s_A = at.arm(0), s_B = at.arm(1);
    const int x = 0, y = 1, z = 2;
    for (int i = 0; i < 3; ++i) {
      const Vector3d a = at.axis(0, i);
      expect_relation({RelationKind::along, static_cast<std::uint8_t>(i), 0}, at, a.dot(d),
                      row(at, -a, -(d + s_A).cross(a), a, s_B.cross(a)));
      for (int j = 0; j < 3; ++j) {
        const Product p = product(at, i, j);
        expect_relation({RelationKind::normal, static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)}, at, p.value,
                        p.G);
      }
    }
    expect_relation({RelationKind::distance, 0, 0}, at, d.norm(), row(at, -n, -s_A.cross(n), n, s_B.cross(n)));
    const Product xy = product(at, x, y), yx = product(at, y, x), xx = product(at, x, x), yy = product(at, y, y);
    expect_relation({RelationKind::twist, 0, 0}, at, xy.value - yx.value, xy.G - yx.G);
    const auto expect_angle = [&](std::uint8_t about, const Product& s, const Product& c) {
      expect_relation({RelationKind::angle, about, 0}, at, std::atan2(s.value, c.value),
                      (c.value * s.G - s.value * c.G) / (s.value * s.value + c.value * c.value));
    };
    expect_angle(2, {yx.value - xy.value, yx.G - xy.G}, {xx.value + yy.value, xx.G + yy.G});
    expect_angle(0, product(at, z, y), yy);
    expect_angle(1, product(at, x, z), xx);
  }
}

/// Two bodies with a revolute joint between them, the first one driven at a joint to the ground.
formats::Scene driven_arm() {
  formats::Scene scene = test_support::empty_scene(0.01, 1.0);
  scene.gravity = {0.3, -0.2, -9.81};
  scene.bodies.push_back(test_support::rigid_body("one", 1.5, Vector3d::Zero(), {0.3, 0.4, 0.5}));
  scene.bodies.push_back(test_support::rigid_body("two", 2.0, Vector3d::Zero(), {0.5, 0.4, 0.3}));
  scene.joints.push_back(
      test_support::joint("base", formats::JointKind::revolute, "ground", "one", {0.2, 0.1, 0.0}, Vector3d::UnitZ()));
  scene.joints.push_back(
      test_support::joint("elbow", formats::JointKind::revolute, "one", "two", {0.5, -0.3, 0.2}, {1, 2, 3}));
  scene.motions.push_back(test_support::drive("base", "0.3*sin(5*t)"));
  return scene;
}

/// B by central differences of φ, at fixed time.
MatrixXd jacobian(test_support::Simulation& run, const State& at) {
  const double h = 1e-6;
  MatrixXd B(run.model().sizes.constraints, at.v().size());
  const auto phi = [&](Eigen::Index k, double by) {
    State moved = at;
    retract(run.model(), at, by * VectorXd::Unit(at.v().size(), k), moved);
    evaluate(run.model(), moved, run.workspace.now);
    return VectorXd(run.workspace.now.constraint);
  };
  for (Eigen::Index k = 0; k < B.cols(); ++k) B.col(k) = (phi(k, h) - phi(k, -h)) / (2.0 * h);
  return B;
}

// (58), (59): Newton and Euler, with the multipliers on the rows of B; velocities and accelerations of the constraints.
TEST(TheoryJoints, EquationsOfMotion) {
  test_support::Simulation run(driven_arm(), {});
  test_support::randomise(run, 5, 0.3, 1.0);
  State& state = run.state();
  state.time() = state.load_time() = 0.2;
  const State at = state;
  const MatrixXd B = jacobian(run, at);
  evaluate(run.model(), at, run.workspace.now);
  evaluate_bias(run.model(), run.workspace.now);
  const VectorXd residual = run.workspace.now.residual, rate = run.workspace.now.constraint_rate,
                 bias = run.workspace.now.bias;

  VectorXd r = B.transpose() * at.lambda();
  const std::array<double, 2> mass{1.5, 2.0};
  const std::array<Vector3d, 2> inertia{Vector3d(0.3, 0.4, 0.5), Vector3d(0.5, 0.4, 0.3)};
  for (std::size_t i = 0; i < 2; ++i) {
    const int node = run.node(i == 0 ? "one" : "two");
    const int x = run.model().nodes[static_cast<std::size_t>(node)].translation,
              turn = run.model().nodes[static_cast<std::size_t>(node)].rotation;
    const Vector3d Omega = at.v().segment<3>(turn), acceleration = at.vdot().segment<3>(x);
    const Vector3d weight = Vector3d(run.scene.gravity);
    r.segment<3>(x) += mass[i] * (acceleration - weight);
    r.segment<3>(turn) += inertia[i].cwiseProduct(Vector3d(at.vdot().segment<3>(turn))) +
                          Omega.cross(Vector3d(inertia[i].cwiseProduct(Omega)));
  }
  EXPECT_LT(test_support::relative_difference(residual, r), 1e-8);  // B by differences
  // φ_t and φ_tt of the drive, whose row is the last one.
  VectorXd phi_t = VectorXd::Zero(B.rows()), phi_tt = phi_t;
  phi_t.tail(1)[0] = -0.3 * 5.0 * std::cos(1.0);
  phi_tt.tail(1)[0] = 0.3 * 25.0 * std::sin(1.0);
  EXPECT_LT(test_support::relative_difference(rate, B * at.v() + phi_t), 1e-8);
  const double h = 1e-5;  // Ḃ v: derivative of B v along v
  const auto moved = [&](double by) {
    State state_by = at;
    retract(run.model(), at, by * at.v(), state_by);
    evaluate(run.model(), state_by, run.workspace.now);
    return VectorXd(run.workspace.now.constraint_rate);
  };
  EXPECT_LT(test_support::relative_difference(bias, (moved(h) - moved(-h)) / (2.0 * h) + phi_tt), 1e-7);
}

// (60): a ball joint and a cylindrical joint with all that their reactions press together.
TEST(TheoryJoints, Friction) {
  for (const formats::JointKind kind : {formats::JointKind::spherical, formats::JointKind::cylindrical}) {
    const Places at(7);
    Joint joint;
    joint.kind = kind;
    joint.a = at.marker[0];
    joint.b = at.marker[1];
    set_relations(kind, {}, joint);
    JointTerms terms;
    joint_constraints(joint, at.node[0], at.node[1], terms);
    const VectorXd lambda = VectorXd::LinSpaced(joint.size(), 2.0, -1.0);
    const Friction friction{.kinetic = 0.2, .stiction = 0.3, .velocity = 0.5, .radius = 0.1, .inverse_arm = 1.0 / 0.4};
    const LoadedJoint loaded{joint, at.pair(), terms, lambda.data()};

    Eigen::Matrix<double, 12, 1> v;
    v << at.node[0].xd, at.node[0].Omega, at.node[1].xd, at.node[1].Omega;
    MatrixXd S(0, 12);
    if (kind == formats::JointKind::spherical) {
      S.setZero(3, 12);
      S.block<3, 3>(0, 3) = -friction.radius * at.node[1].R.transpose() * at.node[0].R;
      S.block<3, 3>(0, 9) = friction.radius * Matrix3d::Identity();
    } else {
      S.resize(2, 12);  // the order of the coordinates of the joint: shift and turn about z
      S.row(0) = evaluate(Relation{RelationKind::along, 2, 0}, at.pair()).G;
      S.row(1) = friction.radius * evaluate(Relation{RelationKind::angle, 2, 0}, at.pair()).G;
    }
    const VectorXd s = S * v;
    const JointReaction reaction = joint_reaction(joint, at.node[0], at.node[1], lambda.data());
    const Pressing& pressing = joint_law(kind).pressing;
    const Vector3d f = Eigen::Map<const Vector3d>(pressing.force.data()).cwiseProduct(reaction.force),
                   m = Eigen::Map<const Vector3d>(pressing.moment.data()).cwiseProduct(reaction.moment);
    const double N = f.norm() + 2.0 * m.norm() / 0.4;
    const double mu = friction_law(friction, s.norm()).ratio * s.norm();
    const VectorXd force = N * mu / s.norm() * S.transpose() * s;
    const FrictionTerms computed = evaluate(friction, loaded);
    EXPECT_NEAR(computed.normal, N, 1e-13 * N);
    EXPECT_LT(test_support::relative_difference(computed.force, force), 1e-13);
    EXPECT_NEAR(computed.power, N * mu * s.norm(), 1e-13 * N);
  }
}

// (61), and the speed of what should stick
TEST(TheoryJoints, FrictionCoefficient) {
  const Friction friction{.kinetic = 0.2, .stiction = 0.35, .velocity = 0.01};
  for (const double sigma : {0.2, 0.8, 1.0, 1.5, 2.7, 3.0, 40.0}) {
    const double t = 0.5 * (sigma - 1.0);
    const double mu = sigma <= 1.0   ? 0.35 * sigma * (2.0 - sigma)
                      : sigma <= 3.0 ? 0.35 - (0.35 - 0.2) * t * t * (3.0 - 2.0 * t)
                                     : 0.2;
    const double speed = 0.01 * sigma;
    EXPECT_NEAR(friction_law(friction, speed).ratio * speed, mu, 1e-15);
  }
  const double share = 2.0 / 3.0, creep = (1.0 - std::sqrt(1.0 - share)) * friction.velocity;
  EXPECT_NEAR(friction_law(friction, creep).ratio * creep, share * 0.35, 1e-15);
}

}  // namespace
}  // namespace tisserand::mechanism::theory_joints_test

// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of all joints against central differences; reactions by their power and by hand.
#include "mechanism/joints/joint.hpp"

#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include "common/math/rotation.hpp"
#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/scenes/joint_kinds.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::joint_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test_support::random_vector;
using Vector12d = Eigen::Matrix<double, 12, 1>;

constexpr int states = 5;

NodeMotion random_motion(std::mt19937& random) {
  NodeMotion motion;
  motion.x = random_vector(random, 2.0);
  motion.R = exp_so3<double>(random_vector(random, 2.0));
  motion.xd = random_vector(random, 1.0);
  motion.Omega = random_vector(random, 1.0);
  return motion;
}

Matrix3d turn(int axis, double angle) { return exp_so3<double>(Vector3d(angle * Vector3d::Unit(axis))); }

/// Where B stands in the axes of A when the joint is met, with something in every direction that is free.
struct Placement {
  Vector3d d = Vector3d::Zero();
  Matrix3d R = Matrix3d::Identity();
};

/// The turn that the relations of a joint leave free, of size `angle` if about one axis; else as of two pins, of a
/// bend, or any.
Matrix3d free_turn(const Joint& joint, double angle, const Vector3d& d, const Matrix3d& any) {
  if (keeps_orientation(joint)) return Matrix3d::Identity();
  if (const int axis = aligned_axis(joint); axis >= 0) return turn(axis, angle);
  for (int k = 0; k < joint.relation_count; ++k) {
    const Relation& r = joint.relations[k];
    if (r.kind == RelationKind::normal) return turn(r.i, angle) * turn(r.j, -0.4);
    // A turn about an axis in the x-y plane has no part about the bisector of the z axes.
    if (r.kind == RelationKind::twist) return exp_so3<double>(Vector3d(d.x(), d.y(), 0));
  }
  return any;
}

Placement placement(const Joint& joint, double angle, std::mt19937& random) {
  Vector3d d = random_vector(random, 1.0);
  const Matrix3d R = free_turn(joint, angle, d, exp_so3<double>(random_vector(random, 2.0)));
  if (joint.coincident) d.setZero();
  for (int k = 0; k < joint.relation_count; ++k)
    if (joint.relations[k].kind == RelationKind::along) d[joint.relations[k].i] = 0.0;
  return {d, R};
}

/// Two bodies with offset markers; `closed`: B stands so that the joint is met.
struct Pair {
  Joint joint;
  NodeMotion a, b;

  Pair(JointKind kind, unsigned seed, double angle) {
    std::mt19937 random(seed);
    joint.a = {0, random_vector(random, 1.0), exp_so3<double>(random_vector(random, 2.0))};
    joint.b = {1, random_vector(random, 1.0), exp_so3<double>(random_vector(random, 2.0))};
    set_relations(kind, {true, false, true, true, false, true}, joint);
    a = random_motion(random);
    b = random_motion(random);
    const Placement p = placement(joint, angle, random);
    if (keeps_distance(joint)) joint.constant = p.d.norm();
    b.R = marker_rotation(joint.a, a) * p.R * joint.b.R.transpose();
    b.x = marker_position(joint.a, a) + marker_rotation(joint.a, a) * p.d - b.R * joint.b.p;
  }
  /// Leaves the constraint, so that derivatives are tested away from Φ = 0 too.
  void open(unsigned seed) {
    std::mt19937 random(seed);
    b.x += random_vector(random, 0.3);
    b.R = (b.R * exp_so3<double>(random_vector(random, 0.5))).eval();
  }
  /// Positions moved by d (material rotations).
  Pair moved(const Vector12d& d) const {
    Pair p = *this;
    p.a.x += d.segment<3>(0);
    p.a.R = (a.R * exp_so3<double>(Vector3d(d.segment<3>(3)))).eval();
    p.b.x += d.segment<3>(6);
    p.b.R = (b.R * exp_so3<double>(Vector3d(d.segment<3>(9)))).eval();
    return p;
  }
  Vector12d velocity() const {
    Vector12d v;
    v << a.xd, a.Omega, b.xd, b.Omega;
    return v;
  }
  JointTerms terms() const {
    JointTerms t;
    t.phi.setZero();
    t.B.setZero();
    t.bias.setZero();
    joint_constraints(joint, a, b, t);
    joint_bias(joint, a, b, t);
    return t;
  }
};

class EveryJoint : public ::testing::TestWithParam<JointKind> {
 protected:
  int size() const { return Pair(GetParam(), 0, 0.7).joint.size(); }
  Eigen::VectorXd multipliers(unsigned seed) const {
    std::mt19937 random(seed + 100);
    return test_support::random_vector_n(random, 6, 1.0);
  }
};

INSTANTIATE_TEST_SUITE_P(Joints, EveryJoint, ::testing::ValuesIn(test_support::every_joint()),
                         test_support::joint_test_name);

// Central differences with d = 1e-5 of functions of size one: truncation 1e-10, round-off 1e-11.
constexpr double step = 1e-5;
constexpr double accuracy = 1e-9;

TEST_P(EveryJoint, IsMetByTheConstructedPose) {
  for (unsigned seed = 0; seed < states; ++seed)
    EXPECT_LT(Pair(GetParam(), seed, 0.7).terms().phi.head(size()).cwiseAbs().maxCoeff(), 1e-14);
}

TEST_P(EveryJoint, JacobianIsTheDerivativeOfPhi) {
  for (unsigned seed = 0; seed < states; ++seed) {
    Pair pair(GetParam(), seed, 0.7);
    pair.open(seed);
    const JointTerms terms = pair.terms();
    for (int j = 0; j < 12; ++j) {
      const Vector12d d = step * Vector12d::Unit(j);
      const Eigen::VectorXd difference =
          (pair.moved(d).terms().phi - pair.moved(-d).terms().phi).head(size()) / (2 * step);
      EXPECT_LT((terms.B.col(j).head(size()) - difference).cwiseAbs().maxCoeff(), accuracy) << "column " << j;
    }
  }
}

// With constant ẋ and Ω the second derivative of Φ is the bias; also twice the difference of Φ itself.
TEST_P(EveryJoint, BiasIsTheChangeOfTheRateOfPhi) {
  for (unsigned seed = 0; seed < states; ++seed) {
    Pair pair(GetParam(), seed, 0.7);
    pair.open(seed);
    const Vector12d v = pair.velocity();
    const Eigen::VectorXd difference =
        (pair.moved(step * v).terms().B * v - pair.moved(-step * v).terms().B * v).head(size()) / (2 * step);
    EXPECT_LT((pair.terms().bias.head(size()) - difference).cwiseAbs().maxCoeff(), 10 * accuracy);
    const double h = 1e-3;  // truncation h² and round-off ε/h² of the second difference
    const Eigen::VectorXd second =
        (pair.moved(h * v).terms().phi - 2 * pair.terms().phi + pair.moved(-h * v).terms().phi).head(size()) / (h * h);
    EXPECT_LT((pair.terms().bias.head(size()) - second).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST_P(EveryJoint, StiffnessIsTheDerivativeOfTheReactions) {
  for (unsigned seed = 0; seed < states; ++seed) {
    Pair pair(GetParam(), seed, 0.7);
    pair.open(seed);
    const Eigen::VectorXd lambda = multipliers(seed);
    const auto force = [&](const Pair& p) -> Vector12d {
      return p.terms().B.topRows(size()).transpose() * lambda.head(size());
    };
    Eigen::Matrix<double, 12, 12> K;
    joint_stiffness(pair.joint, pair.a, pair.b, lambda.data(), K);
    for (int j = 0; j < 12; ++j) {
      const Vector12d d = step * Vector12d::Unit(j);
      const Vector12d difference = (force(pair.moved(d)) - force(pair.moved(-d))) / (2 * step);
      EXPECT_LT((K.col(j) - difference).cwiseAbs().maxCoeff(), 3 * accuracy) << "column " << j;
    }
  }
}

TEST_P(EveryJoint, RateGradientIsTheDerivativeOfTheRate) {
  for (unsigned seed = 0; seed < states; ++seed) {
    Pair pair(GetParam(), seed, 0.7);
    pair.open(seed);
    const Vector12d v = pair.velocity();
    Eigen::Matrix<double, 6, 12> N;
    joint_rate_gradient(pair.joint, pair.a, pair.b, N);
    for (int j = 0; j < 12; ++j) {
      const Vector12d d = step * Vector12d::Unit(j);
      const Eigen::VectorXd difference =
          ((pair.moved(d).terms().B - pair.moved(-d).terms().B) * v).head(size()) / (2 * step);
      EXPECT_LT((N.col(j).head(size()) - difference).cwiseAbs().maxCoeff(), 3 * accuracy) << "column " << j;
    }
  }
}

// The reported wrench, applied to B at B's origin and reversed to A, is the generalised force −Bᵀλ of the equations,
// and has no power on velocities that the joint admits.
TEST_P(EveryJoint, ReportedReactionIsTheForceOfTheEquationsAndDoesNoWork) {
  for (unsigned seed = 0; seed < states; ++seed) {
    const Pair pair(GetParam(), seed, 0.7);
    const Eigen::VectorXd lambda = multipliers(seed);
    const JointTerms terms = pair.terms();
    const JointReaction reaction = joint_reaction(pair.joint, pair.a, pair.b, lambda.data());
    const Matrix3d R_A = marker_rotation(pair.joint.a, pair.a);
    const Vector3d force = R_A * reaction.force, moment = R_A * reaction.moment;
    const Vector3d origin = marker_position(pair.joint.b, pair.b);
    Vector12d nodal;
    nodal << -force, pair.a.R.transpose() * (-moment - (origin - pair.a.x).cross(force)), force,
        pair.b.R.transpose() * (moment + (origin - pair.b.x).cross(force));
    const Vector12d expected = -terms.B.topRows(size()).transpose() * lambda.head(size());
    EXPECT_LT((nodal - expected).cwiseAbs().maxCoeff(), 1e-14);

    // v minus its part in the range of Bᵀ is admissible.
    const Eigen::MatrixXd B = terms.B.topRows(size());
    const Vector12d v = pair.velocity() - B.transpose() * (B * B.transpose()).ldlt().solve(B * pair.velocity());
    EXPECT_GT(v.norm(), 0.1);
    EXPECT_LT(std::abs(nodal.dot(v)), 1e-13);
  }
}

constexpr std::array<int, 6> planar_columns{0, 1, 5, 6, 7, 11};  ///< [x y Θ_z] of both carriers

/// Carriers that turn about z alone, with markers off their planes at one height.
struct PlanarPair : Pair {
  PlanarPair(JointKind kind, unsigned seed, int turns) : Pair(kind, seed, 0.0) {
    std::mt19937 random(seed + 20);
    std::uniform_real_distribution<double> angle(-3.0, 3.0);
    Matrix3d axes;  // of both markers: the normal is z, x or y
    axes.setZero();
    for (int k = 0; k < 3; ++k) axes((k + turns) % 3, k) = 1.0;
    for (NodeMotion* motion : {&a, &b}) {
      motion->R = turn(2, angle(random));
      motion->x.z() = 0.0;
    }
    joint.a.R = turn(2, angle(random)) * axes;
    joint.b.R = turn(2, angle(random)) * axes;
    a.x.z() = 0.2;
    joint.a.p.z() = 0.3;
    b.x.z() = 0.4;
    joint.b.p.z() = 0.1;
    joint.planar = true;
    joint.a.node = 0;
    joint.b.node = 1;
    int kept = 0;
    for (int k = 0; k < joint.relation_count; ++k)
      if (has_planar_axes(joint.relations[k], joint.a, joint.b)) joint.relations[kept++] = joint.relations[k];
    joint.relation_count = kept;
    for (Relation& relation : joint.relations) relation.planar = true;
  }
};

// What a planar joint computes with two translations and a rotation per carrier is what it computes in space.
TEST_P(EveryJoint, OfThePlaneIsThatOfSpace) {
  for (unsigned seed = 0; seed < states; ++seed)
    for (int turns = 0; turns < 3; ++turns) {
      const PlanarPair pair(GetParam(), seed, turns);
      Pair space = pair;
      space.joint.planar = false;
      for (Relation& relation : space.joint.relations) relation.planar = false;
      const int size = pair.joint.size();
      std::vector<int> rows;  // of space: without the third of the places
      for (int k = 0; k < space.joint.size(); ++k)
        if (!pair.joint.coincident || k != 2) rows.push_back(k);
      const JointTerms plane = pair.terms(), all = space.terms();
      const Eigen::VectorXd lambda = multipliers(seed);
      Eigen::VectorXd of_space = Eigen::VectorXd::Zero(6);
      ASSERT_EQ(static_cast<int>(rows.size()), size);
      for (int k = 0; k < size; ++k) {
        EXPECT_NEAR(plane.phi[k], all.phi[rows[k]], 1e-14);
        EXPECT_LT((plane.B.row(k) - all.B.row(rows[k])).cwiseAbs().maxCoeff(), 1e-14) << "row " << k;
        of_space[rows[k]] = lambda[k];
      }
      Vector12d v = Vector12d::Zero();
      for (const int column : planar_columns) v[column] = pair.velocity()[column];
      const auto moved = [&](int first) { return carrier_part<2>(v, first); };
      EXPECT_LT((rows_times<2>(pair.joint, plane, moved(0), moved(6)) - plane.B.topRows<3>() * v).norm(), 1e-14);
      Eigen::Matrix<double, 6, 1> force;
      for (const int carrier : {0, 1})
        force.segment<3>(3 * carrier) = transposed_times<2>(pair.joint, plane, lambda.data(), 6 * carrier);
      Square12 K, K_space;
      joint_stiffness(pair.joint, pair.a, pair.b, lambda.data(), K);
      joint_stiffness(space.joint, space.a, space.b, of_space.data(), K_space);
      const Vector12d expected = all.B.transpose() * of_space;
      EXPECT_LT((force - expected(planar_columns)).cwiseAbs().maxCoeff(), 1e-14);
      for (const int i : planar_columns)
        for (const int j : planar_columns) EXPECT_NEAR(K(i, j), K_space(i, j), 1e-14) << i << " " << j;
      Eigen::Matrix<double, 6, 12> N, N_space;
      Pair moving = pair;
      for (NodeMotion* motion : {&moving.a, &moving.b}) {
        motion->xd.z() = 0.0;
        motion->Omega.head<2>().setZero();
      }
      joint_rate_gradient(pair.joint, moving.a, moving.b, N);
      joint_rate_gradient(space.joint, moving.a, moving.b, N_space);
      for (int k = 0; k < size; ++k)
        for (const int j : planar_columns) EXPECT_NEAR(N(k, j), N_space(rows[k], j), 1e-14) << k << " " << j;
      const JointReaction r = joint_reaction(pair.joint, pair.a, pair.b, lambda.data()),
                          r_space = joint_reaction(space.joint, space.a, space.b, of_space.data());
      EXPECT_LT((r.force - r_space.force).norm() + (r.moment - r_space.moment).norm(), 1e-14);
    }
}

TEST(PlanarRelation, EveryOneIsThatOfSpace) {
  int compared = 0;
  for (int turns = 0; turns < 3; ++turns)
    for (const RelationKind kind :
         {RelationKind::along, RelationKind::normal, RelationKind::twist, RelationKind::distance, RelationKind::angle})
      for (std::uint8_t i = 0; i < 3; ++i)
        for (std::uint8_t j = 0; j < 3; ++j) {
          const PlanarPair pair(JointKind::spherical, 7u + i, turns);
          const Relation relation{kind, i, j}, in_plane{kind, i, j, true};
          if (!has_planar_axes(relation, pair.joint.a, pair.joint.b)) continue;
          ++compared;
          const MarkerPair markers{pair.joint.a, pair.joint.b, pair.a, pair.b};
          const RelationTerms plane = evaluate(in_plane, markers), space = evaluate(relation, markers);
          EXPECT_NEAR(plane.value, space.value, 1e-14);
          EXPECT_LT((plane.G - space.G).cwiseAbs().maxCoeff(), 1e-14) << static_cast<int>(kind);
          Square12 K = Square12::Zero(), K_space = Square12::Zero();
          add_stiffness(in_plane, markers, 0.7, K);
          add_stiffness(relation, markers, 0.7, K_space);
          for (const int row : planar_columns)
            for (const int column : planar_columns)
              EXPECT_NEAR(K(row, column), K_space(row, column), 1e-14) << static_cast<int>(kind);
        }
  // Of three orientations: two axes along, four pairs of axes, one twist, any distance, one angle (times i and j).
  EXPECT_EQ(compared, 3 * (2 * 3 + 4) + 9 + 27 + 3 * 3);
}

TEST_P(EveryJoint, RigidMotionOfTheWorldChangesNothing) {
  for (unsigned seed = 0; seed < states; ++seed) {
    Pair pair(GetParam(), seed, 0.7);
    pair.open(seed);
    std::mt19937 random(seed + 50);
    const Matrix3d Q = exp_so3<double>(random_vector(random, 3.0));
    const Vector3d shift = random_vector(random, 5.0);
    Pair turned = pair;
    for (NodeMotion* motion : {&turned.a, &turned.b}) {
      motion->x = Q * motion->x + shift;
      motion->R = Q * motion->R;
      motion->xd = Q * motion->xd;
    }
    const JointTerms before = pair.terms(), after = turned.terms();
    if (pair.joint.coincident) {
      EXPECT_LT((after.phi.head<3>() - Q * before.phi.head<3>()).norm(), 1e-14);
      EXPECT_LT((after.bias.head<3>() - Q * before.bias.head<3>()).norm(), 1e-13);
    }
    for (int k = pair.joint.coincident ? 3 : 0; k < size(); ++k) {
      EXPECT_NEAR(after.phi[k], before.phi[k], 1e-13);  // positions of size 10
      EXPECT_NEAR(after.bias[k], before.bias[k], 1e-12);
    }
    Eigen::VectorXd lambda = multipliers(seed);
    const JointReaction r = joint_reaction(pair.joint, pair.a, pair.b, lambda.data());
    if (pair.joint.coincident) lambda.head<3>() = (Q * lambda.head<3>()).eval();
    const JointReaction s = joint_reaction(turned.joint, turned.a, turned.b, lambda.data());
    EXPECT_LT((r.force - s.force).norm() + (r.moment - s.moment).norm(), 1e-13);
  }
}

/// World force and moment on B of the only joint of a scene, at its origin.
JointReaction world_reaction(test_support::Simulation& run) {
  const Joint& joint = run.model().joints.front();
  evaluate(run.model(), run.state(), run.workspace.now);
  const auto motion = [&](int node) { return node < 0 ? NodeMotion{} : run.workspace.now.motion[node]; };
  const JointReaction r =
      joint_reaction(joint, motion(joint.a.node), motion(joint.b.node), run.state().lambda().data() + joint.row);
  const Matrix3d R = marker_rotation(joint.a, motion(joint.a.node));
  return {R * r.force, R * r.moment};
}

// Two moving bodies under gravity and a moment; the joint once from one to the other and once back.
TEST_P(EveryJoint, SwappingTheBodiesFlipsTheReactions) {
  const auto reaction = [](const std::string& a, const std::string& b) {
    formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
    scene.gravity = {0.4, -0.3, -9.81};
    for (const std::string name : {"one", "two"}) {
      formats::RigidBodySpec body = test_support::rigid_body(name, name == "one" ? 2.0 : 3.0,
                                                             {0.4, 0.1, name == "one" ? 0.2 : -0.3}, {0.2, 0.3, 0.4});
      body.start.angular_velocity = {1.0, -2.0, 0.5};
      scene.bodies.push_back(body);
    }
    formats::JointSpec spec = test_support::joint("j", GetParam(), a, b, Vector3d::Zero(), {0.3, 0.5, 1.0});
    test_support::give_own_key(spec, "one");
    scene.joints.push_back(spec);
    scene.loads.push_back(test_support::constant_load("m", formats::LoadKind::moment, "one", {2, 3, -4}));
    test_support::Simulation run(scene, {});
    run.start();
    return world_reaction(run);
  };
  const JointReaction forth = reaction("one", "two"), back = reaction("two", "one");
  EXPECT_GT(forth.force.norm() + forth.moment.norm(), 0.1);
  // Accelerations of size 10 and a condition number of about 100.
  EXPECT_LT((forth.force + back.force).norm(), 1e-11);
  EXPECT_LT((forth.moment + back.moment).norm(), 1e-11);
}

// A body of weight 2·9.81 N clamped to ground 0.3 m beside its centre of mass: ground carries the weight and, by r × W
// + M = 0 with r = 0.3 e_x, W = −2·9.81 e_z, the moment −0.3·2·9.81 e_y; expressed in A's axes, which are turned by 90
// degrees about x.
TEST(JointReaction, SignAgainstAStaticCalculationByHand) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.gravity = {0, 0, -9.81};
  scene.bodies.push_back(test_support::rigid_body("body", 2.0, {0.3, 0, 0}, {0.1, 0.2, 0.3}));
  formats::JointSpec clamp =
      test_support::joint("clamp", JointKind::fixed, "ground", "body", Vector3d::Zero(), Vector3d::UnitZ());
  clamp.axis.reset();
  clamp.a.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX()));
  scene.joints.push_back(clamp);
  test_support::Simulation run(scene, {});
  run.start();
  evaluate(run.model(), run.state(), run.workspace.now);
  const JointReaction r =
      joint_reaction(run.model().joints[0], NodeMotion{}, run.workspace.now.motion[0], run.state().lambda().data());
  const double weight = 2.0 * 9.81;
  // A's axes: y along world z, z along world −y.
  EXPECT_LT((r.force - Vector3d(0, weight, 0)).norm(), 1e-12 * weight);
  EXPECT_LT((r.moment - Vector3d(0, 0, 0.3 * weight)).norm(), 1e-12 * weight);
}

// What the joint holds and what its coordinates measure are independent: a driven coordinate adds a constraint.
TEST_P(EveryJoint, CoordinatesAreFree) {
  for (unsigned seed = 0; seed < states; ++seed) {
    const Pair pair(GetParam(), seed, 0.7);
    const std::vector<NamedRelation> free = free_coordinates(pair.joint);
    const int held = size(), count = static_cast<int>(free.size());
    Eigen::MatrixXd rows(held + count, 12);
    rows.topRows(held) = pair.terms().B.topRows(held);
    for (int k = 0; k < count; ++k)
      rows.row(held + k) = evaluate(free[k].relation, {pair.joint.a, pair.joint.b, pair.a, pair.b}).G;
    EXPECT_GT(rows.jacobiSvd().singularValues().minCoeff(), 1e-3);
  }
}

// What placement() put in: the turn about z, the shift along the axes of A, and R = R_x(angle) R_y(−0.4).
TEST_P(EveryJoint, CoordinatesMeasureThePlacement) {
  for (const double angle : {-3.0, -1.2, 0.0, 0.4, 2.9}) {
    const Pair pair(GetParam(), 3, angle);
    const Vector3d d = marker_rotation(pair.joint.a, pair.a).transpose() *
                       (marker_position(pair.joint.b, pair.b) - marker_position(pair.joint.a, pair.a));
    const std::map<std::string, double> expected{{"x", d.x()},     {"y", d.y()},       {"z", d.z()},
                                                 {"angle", angle}, {"angle_x", angle}, {"angle_y", -0.4}};
    for (const NamedRelation& free : free_coordinates(pair.joint)) {
      const double value = evaluate(free.relation, {pair.joint.a, pair.joint.b, pair.a, pair.b}).value;
      EXPECT_NEAR(value, expected.at(free.name), 1e-14) << free.name;
    }
  }
}

// The four derivatives of every relation, away from the constraint, against central differences.
TEST(Relation, DerivativesAreThoseOfTheValue) {
  const std::vector<Relation> all{{RelationKind::along, 0, 0},    {RelationKind::along, 2, 0},
                                  {RelationKind::normal, 1, 2},   {RelationKind::twist, 0, 0},
                                  {RelationKind::distance, 0, 0}, {RelationKind::angle, 0, 0},
                                  {RelationKind::angle, 1, 0},    {RelationKind::angle, 2, 0}};
  for (const Relation& relation : all)
    for (unsigned seed = 0; seed < states; ++seed) {
      SCOPED_TRACE(::testing::Message() << "kind " << static_cast<int>(relation.kind) << ", axis " << int{relation.i});
      Pair pair(JointKind::cylindrical, seed, 0.7);
      pair.open(seed);
      const auto at = [&](const Pair& p) { return evaluate(relation, {p.joint.a, p.joint.b, p.a, p.b}); };
      const MarkerPair markers{pair.joint.a, pair.joint.b, pair.a, pair.b};
      const Vector12d v = pair.velocity();
      const Row12 G = at(pair).G, N = rate_gradient(relation, markers);
      Square12 K = Square12::Zero();
      add_stiffness(relation, markers, 1.3, K);
      for (int j = 0; j < 12; ++j) {
        const Vector12d d = step * Vector12d::Unit(j);
        const RelationTerms after = at(pair.moved(d)), before = at(pair.moved(-d));
        EXPECT_NEAR(G[j], (after.value - before.value) / (2 * step), accuracy);
        const Row12 change = (after.G - before.G) / (2 * step);
        EXPECT_NEAR(N[j], change.dot(v), 10 * accuracy);
        EXPECT_LT((K.col(j) - 1.3 * change.transpose()).cwiseAbs().maxCoeff(), 10 * accuracy);
      }
      const double change = (at(pair.moved(step * v)).G - at(pair.moved(-step * v)).G).dot(v) / (2 * step);
      EXPECT_NEAR(bias(relation, markers), change, 100 * accuracy);
    }
}

// A free rotor at 20 rad/s: 3.2 turns in a second, both ways.
TEST(Hinge, AngleIsUnwrappedOverSeveralTurns) {
  for (const double rate : {20.0, -20.0}) {
    formats::Scene scene = test_support::empty_scene(0.01, 1.0);
    formats::RigidBodySpec rotor = test_support::rigid_body("rotor", 1.0, Vector3d::Zero(), {0.1, 0.2, 0.3});
    const Vector3d axis = Vector3d(1, 2, -1).normalized();
    rotor.start.pose.orientation = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis);
    rotor.start.angular_velocity = rate * axis;
    scene.bodies.push_back(rotor);
    scene.joints.push_back(test_support::joint("axle", JointKind::revolute, "ground", "rotor", Vector3d::Zero(), axis));
    test_support::Simulation run(scene, {});
    run.start();
    run.run(1.0);
    EXPECT_NEAR(run.state().hinges()[0], rate, 1e-8);
  }
}

}  // namespace
}  // namespace tisserand::mechanism::joint_test

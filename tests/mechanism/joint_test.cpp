// One suite for all joints: derivatives against central differences, reactions by their power and by hand.
#include "mechanism/joints/joint.hpp"

#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "common/rotation.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/superelement_cases.hpp"

namespace tisserand::mechanism {
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

/// Two bodies with offset markers; `closed`: B stands so that the joint is met.
struct Pair {
  Joint joint;
  NodeMotion a, b;

  Pair(JointKind kind, unsigned seed, double angle) {
    std::mt19937 random(seed);
    joint.kind = kind;
    joint.a = {0, random_vector(random, 1.0), exp_so3<double>(random_vector(random, 2.0))};
    joint.b = {1, random_vector(random, 1.0), exp_so3<double>(random_vector(random, 2.0))};
    a = random_motion(random);
    b = random_motion(random);
    Matrix3d relative = Matrix3d::Identity();
    if (kind == JointKind::revolute) relative = exp_so3<double>(Vector3d(0, 0, angle));
    if (kind == JointKind::spherical) relative = exp_so3<double>(random_vector(random, 2.0));
    b.R = marker_rotation(joint.a, a) * relative * joint.b.R.transpose();
    b.x = marker_position(joint.a, a) - b.R * joint.b.p;
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

class EveryJoint : public testing::TestWithParam<JointKind> {
 protected:
  int size() const { return joint_size(GetParam()); }
  Eigen::VectorXd multipliers(unsigned seed) const {
    std::mt19937 random(seed + 100);
    return test_support::random_vector_n(random, 6, 1.0);
  }
};

INSTANTIATE_TEST_SUITE_P(Joints, EveryJoint,
                         testing::Values(JointKind::fixed, JointKind::revolute, JointKind::spherical),
                         [](const testing::TestParamInfo<JointKind>& kind) {
                           switch (kind.param) {
                             case JointKind::fixed:
                               return "fixed";
                             case JointKind::revolute:
                               return "revolute";
                             case JointKind::spherical:
                               return "spherical";
                           }
                           return "";
                         });

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
    EXPECT_LT((after.phi.head<3>() - Q * before.phi.head<3>()).norm(), 1e-14);
    EXPECT_LT((after.bias.head<3>() - Q * before.bias.head<3>()).norm(), 1e-14);
    for (int k = 3; k < size(); ++k) {
      EXPECT_NEAR(after.phi[k], before.phi[k], 1e-14);
      EXPECT_NEAR(after.bias[k], before.bias[k], 1e-14);
    }
    Eigen::VectorXd lambda = multipliers(seed);
    const JointReaction r = joint_reaction(pair.joint, pair.a, pair.b, lambda.data());
    lambda.head<3>() = (Q * lambda.head<3>()).eval();
    const JointReaction s = joint_reaction(turned.joint, turned.a, turned.b, lambda.data());
    EXPECT_LT((r.force - s.force).norm() + (r.moment - s.moment).norm(), 1e-13);
  }
}

/// World force and moment on B of the only joint of a scene, at its origin.
JointReaction world_reaction(test_support::Simulation& run) {
  const Joint& joint = run.model().joints.front();
  evaluate(run.model(), run.state(), run.workspace);
  const auto motion = [&](int node) {
    return node < 0 ? NodeMotion{} : run.workspace.motion[static_cast<std::size_t>(node)];
  };
  const JointReaction r =
      joint_reaction(joint, motion(joint.a.node), motion(joint.b.node), run.state().lambda().data() + joint.row);
  const Matrix3d R = marker_rotation(joint.a, motion(joint.a.node));
  return {R * r.force, R * r.moment};
}

// Two moving bodies under gravity and a moment; the joint once from one to the other and once back.
TEST_P(EveryJoint, SwappingTheBodiesFlipsTheReactions) {
  const auto reaction = [this](const std::string& a, const std::string& b) {
    formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
    scene.gravity = {0.4, -0.3, -9.81};
    for (const std::string name : {"one", "two"}) {
      formats::RigidBodySpec body = test_support::rigid_body(name, name == "one" ? 2.0 : 3.0,
                                                             {0.4, 0.1, name == "one" ? 0.2 : -0.3}, {0.2, 0.3, 0.4});
      body.start.angular_velocity = {1.0, -2.0, 0.5};
      scene.bodies.push_back(body);
    }
    scene.joints.push_back(test_support::joint("j", GetParam(), a, b, Vector3d::Zero(), {0.3, 0.5, 1.0}));
    scene.loads.push_back(test_support::constant_load("m", formats::LoadKind::moment, "one", {2, 3, -4}));
    test_support::Simulation run(scene, {});
    run.start();
    return world_reaction(run);
  };
  const JointReaction forth = reaction("one", "two"), back = reaction("two", "one");
  EXPECT_GT(forth.force.norm(), 0.1);
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
  evaluate(run.model(), run.state(), run.workspace);
  const JointReaction r =
      joint_reaction(run.model().joints[0], NodeMotion{}, run.workspace.motion[0], run.state().lambda().data());
  const double weight = 2.0 * 9.81;
  // A's axes: y along world z, z along world −y.
  EXPECT_LT((r.force - Vector3d(0, weight, 0)).norm(), 1e-12 * weight);
  EXPECT_LT((r.moment - Vector3d(0, 0, 0.3 * weight)).norm(), 1e-12 * weight);
}

TEST(Hinge, AngleIsRightHandedAboutZOfA) {
  for (const double angle : {-3.0, -1.2, 0.0, 0.4, 2.9}) {
    const Pair pair(JointKind::revolute, 3, angle);
    EXPECT_NEAR(hinge_angle(pair.joint, pair.a, pair.b), angle, 1e-14);
    const double h = 1e-5;
    const Vector12d v = pair.velocity();
    const Pair before = pair.moved(-h * v), after = pair.moved(h * v);
    // The bodies turn freely here, so the rate of the angle about z of A holds to first order in the tilt: at Φ = 0
    // exactly.
    const double difference =
        (hinge_angle(pair.joint, after.a, after.b) - hinge_angle(pair.joint, before.a, before.b)) / (2 * h);
    EXPECT_NEAR(hinge_rate(pair.joint, pair.a, pair.b), difference, 1e-8);
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
}  // namespace tisserand::mechanism

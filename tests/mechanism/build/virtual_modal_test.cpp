// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual bodies on nodes of modal bodies, and joints between modal and rigid bodies: the known answers of [GA00]
// sections 3 and 4, kept against eliminated, loops of ties.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/scenes/virtual_bodies.hpp"

namespace tisserand::mechanism::virtual_modal_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;
using formats::VirtualBodies;
using test_support::expect_equal;
using test_support::fixed_joint;
using test_support::Outcome;
using test_support::relative_difference;
using test_support::run_scene;
using test_support::Simulation;
using test_support::to_matrix;
using test_support::to_vector;
using test_support::virtual_body;

/// What the known answers are given to: sums of products of numbers of order one, so round-off alone.
constexpr double known_tolerance = 1e-11;

BodyFiles known_files(const nlohmann::json& answers) {
  BodyFiles files;
  for (const char* reference : {"node_fixed", "mean_axis"})
    files.modal_bodies[reference].body = test_support::known_body(answers, reference);
  return files;
}

/// A body's place and velocity as in the file: r, A, rdot, omega (in its own axes).
void place(Simulation& run, const std::string& name, const nlohmann::json& known) {
  const int node = run.node(name);
  State& state = run.state();
  state.x().col(node) = to_vector(known.at("r"));
  state.Q().col(node) = wxyz(Eigen::Quaterniond(Matrix3d(to_matrix(known.at("A")))));
  const Node& at = run.model().nodes[node];
  state.v().segment<3>(at.translation) = to_vector(known.at("rdot"));
  state.v().segment<3>(at.rotation) = to_vector(known.at("omega"));
}

/// A joint between markers that are given on their nodes.
formats::JointSpec between(const std::string& name, JointKind kind, const formats::MarkerSpec& a,
                           const formats::MarkerSpec& b) {
  formats::JointSpec spec;
  spec.name = name;
  spec.kind = kind;
  spec.a = a;
  spec.b = b;
  return spec;
}

formats::MarkerSpec marker(const std::string& node, const Vector3d& position, const Matrix3d& axes) {
  formats::MarkerSpec spec;
  spec.node = node;
  spec.position = position;
  spec.orientation = Eigen::Quaterniond(axes);
  return spec;
}

// ---- known answers -------------------------------------------------------------------------------------------------

/// R and R3 (rigid), F and F2 (modal) in the state of the known answers, with their four joints.
struct KnownJoints {
  nlohmann::json answers = test_support::modal_answers();
  nlohmann::json known = answers.at("joints");
  Simulation run{scene(), known_files(answers)};

  KnownJoints() {
    const nlohmann::json& bodies = known.at("bodies");
    for (const char* name : {"R", "R3", "F", "F2"}) place(run, name, bodies.at(name));
    State& state = run.state();
    state.w() << to_vector(bodies.at("F").at("w")), to_vector(bodies.at("F2").at("w"));
    state.v().tail(6) << to_vector(bodies.at("F").at("wdot")), to_vector(bodies.at("F2").at("wdot"));
  }

  formats::Scene scene() const {
    formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
    scene.bodies = {test_support::rigid_body("R", 1.0, Vector3d::Zero(), Vector3d::Ones()),
                    test_support::rigid_body("R3", 1.0, Vector3d::Zero(), Vector3d::Ones()),
                    test_support::modal_spec("F", "node_fixed"), test_support::modal_spec("F2", "mean_axis")};
    const Matrix3d I = Matrix3d::Identity();
    const auto at = [&I](const std::string& node, const nlohmann::json& s) { return marker(node, to_vector(s), I); };
    const nlohmann::json &rr = known.at("rigid_rigid"), &fr = known.at("flexible_rigid"),
                         &rigid = known.at("rigid_joint_off_manifold");
    scene.joints = {
        between("rr", JointKind::spherical, at("R3", rr.at("s_j")), at("R", rr.at("s_i"))),
        between("fr", JointKind::spherical, marker("F/n3", Vector3d::Zero(), I), at("R", fr.at("s_j"))),
        between("ff", JointKind::spherical, marker("F/n3", Vector3d::Zero(), I), marker("F2/n4", Vector3d::Zero(), I)),
        between("rigid", JointKind::fixed, marker("F/n5", Vector3d::Zero(), to_matrix(rigid.at("C"))),
                at("R", rigid.at("s")))};
    return scene;
  }

  /// Rows of a joint on the velocities of these bodies, with modes: the rate of Φ is linear in v.
  MatrixXd jacobian(int row, int rows, const std::vector<int>& columns) {
    const VectorXd v = run.state().v();
    MatrixXd J(rows, static_cast<Eigen::Index>(columns.size()));
    for (Eigen::Index j = 0; j < J.cols(); ++j) {
      run.state().v() = VectorXd::Unit(v.size(), columns[j]);
      evaluate(run.model(), run.state(), run.workspace.now);
      J.col(j) = run.workspace.now.constraint_rate.segment(row, rows);
    }
    run.state().v() = v;
    evaluate(run.model(), run.state(), run.workspace.now);
    evaluate_bias(run.model(), run.workspace.now);
    return J;
  }

  /// Coordinates of a body in the order of the file: translations, rotations, modes.
  std::vector<int> columns(const std::vector<std::string>& bodies) const {
    std::vector<int> all;
    for (const std::string& name : bodies) {
      const Node& node = run.model().nodes[run.node(name)];
      for (int i = 0; i < 3; ++i) all.push_back(node.translation + i);
      for (int i = 0; i < 3; ++i) all.push_back(node.rotation + i);
      const int modes = run.model().sizes.boundary - (name == "F" ? 6 : 3);
      for (int i = 0; i < 3 && name[0] == 'F'; ++i) all.push_back(modes + i);
    }
    return all;
  }
};

// (17)-(32) in their corrected form: Φ, its rows on velocities, and γ = what Φ̈ lacks without accelerations.
TEST(JointsOfModalBodies, SphericalOnesAreTheKnownAnswers) {
  KnownJoints k;
  const std::vector<std::tuple<std::string, int, std::vector<std::string>>> joints{
      {"rigid_rigid", 0, {"R", "R3"}}, {"flexible_rigid", 3, {"R", "F"}}, {"flexible_flexible", 6, {"F2", "F"}}};
  for (const auto& [name, row, bodies] : joints) {
    const nlohmann::json& known = k.known.at(name);
    EXPECT_LT(relative_difference(k.jacobian(row, 3, k.columns(bodies)), to_matrix(known.at("J"))), known_tolerance);
    EXPECT_LT(relative_difference(k.run.workspace.now.constraint.segment<3>(row), to_vector(known.at("Phi"))),
              known_tolerance)
        << name;
    EXPECT_LT(relative_difference(-k.run.workspace.now.bias.segment<3>(row), to_vector(known.at("gamma"))),
              known_tolerance)
        << name;
  }
}

// (33)-(42): translations as they stand; the three equations of the orientation are another choice off the constraint,
// but demand the same of the velocities: the rows of one are combinations of those of the other.
TEST(JointsOfModalBodies, RigidJointIsTheKnownAnswer) {
  KnownJoints k;
  const nlohmann::json& known = k.known.at("rigid_joint_off_manifold");
  const MatrixXd J = k.jacobian(9, 6, k.columns({"R", "F"})), expected = to_matrix(known.at("J"));
  EXPECT_LT(relative_difference(J.topRows(3), expected.topRows(3)), known_tolerance);
  EXPECT_LT(relative_difference(k.run.workspace.now.constraint.segment<3>(9), to_vector(known.at("Phi")).head<3>()),
            known_tolerance);
  EXPECT_LT(relative_difference(-k.run.workspace.now.bias.segment<3>(9), to_vector(known.at("gamma")).head<3>()),
            known_tolerance);
  const MatrixXd rows = J.bottomRows(3).transpose(), wanted = expected.bottomRows(3).transpose();
  const MatrixXd combination = rows.colPivHouseholderQr().solve(wanted);
  EXPECT_GT(std::abs(combination.determinant()), 0.01);
  EXPECT_LT(relative_difference(rows * combination, wanted), known_tolerance);
}

/// Modal body F, virtual body V rigidly on its node 5, rigid body B on a ball of V; a force and a moment on node 4.
formats::Scene chain(const nlohmann::json& answers, VirtualBodies treatment) {
  const nlohmann::json& kkt = answers.at("kkt");
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.virtual_bodies = treatment;
  scene.gravity = to_vector(kkt.at("gravity"));
  const formats::ModalBodySpec F = test_support::modal_spec("F", "node_fixed");
  formats::RigidBodySpec B =
      test_support::rigid_body("B", kkt.at("B").at("mass").get<double>(), Vector3d::Zero(), Vector3d::Ones());
  B.inertia = to_matrix(kkt.at("B").at("J"));
  // Undeformed at the start, where V meets its tie; the deformed state is set afterwards.
  const Matrix3d C = to_matrix(kkt.at("C"));
  const Vector3d offset = to_vector(kkt.at("node_in_V_axes"));
  formats::VirtualBodySpec V =
      virtual_body("V", Vector3d(to_matrix(answers.at("body").at("x")).row(4).transpose()) - C * offset);
  V.start.pose.orientation = Eigen::Quaterniond(C);
  scene.bodies = {F, V, B};
  const Matrix3d I = Matrix3d::Identity();
  scene.joints = {between("tie", JointKind::fixed, marker("F/n5", Vector3d::Zero(), C), marker("V", offset, I)),
                  between("ball", JointKind::spherical, marker("B", to_vector(kkt.at("spherical_point_B")), I),
                          marker("V", to_vector(kkt.at("spherical_point_V")), I))};
  using formats::LoadKind;
  const nlohmann::json& nodal = kkt.at("nodal_force");
  scene.loads = {test_support::constant_load("f", LoadKind::force, "F/n4", to_vector(nodal.at("force_global"))),
                 test_support::constant_load("m", LoadKind::moment, "F/n4", to_vector(nodal.at("moment_global"))),
                 test_support::constant_load("F", LoadKind::force, "B", to_vector(kkt.at("B_force_global"))),
                 test_support::constant_load("M", LoadKind::moment, "B", to_vector(kkt.at("B_torque_local")))};
  scene.loads[3].axes = formats::LoadAxes::body;
  return scene;
}

// The same accelerations and the same wrench in the tie as the independent program, with V kept and eliminated. The
// multipliers of the file: M a + Jᵀ λ = .. with the rows of 3.4, so F pushes V with -λ at node 5, the moment in the
// axes of V; the results give it in the axes of the tie's marker A, which are those of V.
TEST(VirtualBodyOnAModalNode, AccelerationsAndTieAreTheKnownAnswers) {
  const nlohmann::json answers = test_support::modal_answers(), &kkt = answers.at("kkt");
  BodyFiles files = known_files(answers);
  files.modal_bodies["node_fixed"].body.zeta = to_vector(kkt.at("modal_damping_ratio"));
  const VectorXd vdot = to_vector(kkt.at("vdot")), lambda = to_vector(kkt.at("lambda"));
  for (const VirtualBodies treatment : {VirtualBodies::keep, VirtualBodies::eliminate}) {
    const bool kept = treatment == VirtualBodies::keep;
    const formats::Scene scene = chain(answers, treatment);
    Simulation run(scene, files);
    const nlohmann::json& F = answers.at("joints").at("bodies").at("F");
    place(run, "F", F);
    place(run, "B", kkt.at("B"));
    if (kept) place(run, "V", kkt.at("V"));
    run.state().w() = to_vector(F.at("w"));
    run.state().v().tail(3) = to_vector(F.at("wdot"));
    evaluate(run.model(), run.state(), run.workspace.now);
    EXPECT_LT(run.workspace.now.constraint.norm(), 1e-14);
    EXPECT_LT(run.workspace.now.constraint_rate.norm(), 1e-14);
    ASSERT_FALSE(solve_accelerations(run.model(), 1e-3, "", run.state(), run.workspace));
    VectorXd expected(kept ? 21 : 15);  // the virtual body after those with mass, modes last
    if (kept)
      expected << vdot.head(6), vdot.tail(6), vdot.segment(9, 6), vdot.segment(6, 3);
    else
      expected << vdot.head(6), vdot.tail(6), vdot.segment(6, 3);
    EXPECT_LT(relative_difference(run.state().vdot(), expected), known_tolerance);
    const Outcome outcome = test_support::outcome_of(scene, run);
    const VectorXd& tie = outcome.reaction.at("tie");
    const Matrix3d axes = to_matrix(kkt.at("V").at("A"));
    EXPECT_LT(relative_difference(axes * tie.head<3>(), -lambda.head<3>()), known_tolerance);
    EXPECT_LT(relative_difference(tie.tail<3>(), -lambda.segment<3>(3)), known_tolerance);
  }
}

// ---- motion --------------------------------------------------------------------------------------------------------

/// The body of the known answers swings on a hinge through two virtual bodies, and carries a ball through a third, on
/// which a spring and a force act; virtual body `hub` holds nodes 2 and 3 together.
formats::Scene swing(VirtualBodies treatment, bool hub) {
  const nlohmann::json answers = test_support::modal_answers();
  const MatrixXd x = to_matrix(answers.at("body").at("x"));
  const auto node = [&x](int k) { return Vector3d(x.row(k - 1).transpose()); };
  formats::Scene scene = test_support::precise_scene(formats::Formulation::stabilised_index2);
  scene.virtual_bodies = treatment;
  scene.gravity = {0, 0, -9.81};
  formats::RigidBodySpec ball = test_support::rigid_body("ball", 0.7, Vector3d::Zero(), {0.02, 0.03, 0.04});
  ball.start.pose.position = node(5) + Vector3d(0.2, 0, 0);
  formats::VirtualBodySpec tip = virtual_body("tip", node(5) + Vector3d(0.1, 0, 0));
  tip.nodes = {{"horn", {{0.02, 0.03, 0.01}, Eigen::Quaterniond::Identity()}}};
  scene.bodies = {test_support::modal_spec("F", "node_fixed"), virtual_body("inner", node(1)),
                  virtual_body("outer", node(1) - Vector3d(0.1, 0, 0)), tip, ball};
  scene.joints = {fixed_joint("inner_tie", "F/n1", "inner"), fixed_joint("outer_tie", "inner", "outer"),
                  test_support::joint("hinge", JointKind::revolute, "ground", "outer", node(1), {0, 1, 0}),
                  fixed_joint("tip_tie", "F/n5", "tip"),
                  test_support::joint("pin", JointKind::spherical, "tip", "ball", node(5), {0, 0, 1})};
  if (hub) {
    scene.bodies.push_back(virtual_body("hub", node(2)));
    scene.joints.push_back(fixed_joint("hub_2", "F/n2", "hub"));
    scene.joints.push_back(fixed_joint("hub_3", "hub", "F/n3"));
  }
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.a.node = "ground";
  spring.a.position = Vector3d(1.5, 0.2, 0.1);
  spring.b.node = "tip/horn";
  spring.stiffness = 50.0;
  spring.damping = 2.0;
  spring.free = 0.1;
  scene.springs.push_back(spring);
  scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, "tip/horn", {3, -2, 1}));
  scene.loads.back().axes = formats::LoadAxes::body;
  return scene;
}

// Neither mass nor freedom of their own: the same equations (exact form of [GA00] (33)-(42)). Three modes bend the body
// in space here, which the printed (38), not integrable, would let the virtual bodies creep with.
TEST(VirtualBodyOnAModalNode, KeptAndEliminatedMoveTheSame) {
  const BodyFiles files = known_files(test_support::modal_answers());
  const Outcome kept = run_scene(swing(VirtualBodies::keep, false), files, 0.1);
  const Outcome eliminated = run_scene(swing(VirtualBodies::eliminate, false), files, 0.1);
  EXPECT_GT(test_support::largest(kept.reaction), 5.0);
  expect_equal(kept.motion, eliminated.motion, 1e-9);
  expect_equal(kept.reaction, eliminated.reaction, 1e-7);
}

// Index 3 leaves the velocities of kept virtual bodies to the integrator, so no damper may feel them.
TEST(VirtualBodyOnAModalNode, KeptAndEliminatedMoveTheSameWithIndex3) {
  const BodyFiles files = known_files(test_support::modal_answers());
  const auto moved = [&](VirtualBodies treatment) {
    formats::Scene scene = swing(treatment, false);
    scene.integrator.formulation = formats::Formulation::index3;
    scene.springs[0].damping = 0.0;
    Outcome outcome = run_scene(scene, files, 0.1);
    for (const char* name : {"inner", "outer", "tip", "tip/horn"}) outcome.motion.at(name).segment<6>(3).setZero();
    return outcome;
  };
  const Outcome kept = moved(VirtualBodies::keep), eliminated = moved(VirtualBodies::eliminate);
  expect_equal(kept.motion, eliminated.motion, 1e-9);
  expect_equal(kept.reaction, eliminated.reaction, 1e-7);
}

// Two nodes of one body: one tie is eliminated, the other stays a joint that locks what the modes do between the nodes.
TEST(VirtualBodyOnAModalNode, BetweenTwoNodesLocksTheirDistance) {
  const BodyFiles files = known_files(test_support::modal_answers());
  EXPECT_EQ(build_model(swing(VirtualBodies::eliminate, true), files).model.ties.size(), 4u);
  const Outcome kept = run_scene(swing(VirtualBodies::keep, true), files, 0.1);
  const Outcome eliminated = run_scene(swing(VirtualBodies::eliminate, true), files, 0.1);
  expect_equal(kept.motion, eliminated.motion, 1e-9);
}

/// A third virtual body on the inner one; the tie from it to the outer one, off by `gap`, closes a loop.
formats::Scene loop(VirtualBodies treatment, double gap) {
  formats::Scene scene = swing(treatment, false);
  formats::VirtualBodySpec third = std::get<formats::VirtualBodySpec>(scene.bodies[1]);
  third.name = "third";
  scene.bodies.push_back(third);
  scene.joints.push_back(fixed_joint("third_tie", "inner", "third"));
  const Matrix3d I = Matrix3d::Identity();
  scene.joints.push_back(
      between("loop", JointKind::fixed, marker("third", {-0.1, 0, gap}, I), marker("outer", Vector3d::Zero(), I)));
  return scene;
}

// A loop that closes changes nothing; kept, its six equations are found redundant.
TEST(LoopOnAModalNode, ThatClosesMovesAsWithout) {
  const BodyFiles files = known_files(test_support::modal_answers());
  const Outcome open = run_scene(swing(VirtualBodies::eliminate, false), files, 0.1);
  for (const VirtualBodies treatment : {VirtualBodies::keep, VirtualBodies::eliminate}) {
    Outcome closed = run_scene(loop(treatment, 0.0), files, 0.1);
    closed.motion.erase("third");
    expect_equal(open.motion, closed.motion, 1e-9);
  }
  Simulation kept(loop(VirtualBodies::keep, 0.0), files);
  kept.start();
  EXPECT_EQ(kept.started.mobility.constraints - kept.started.mobility.rank, 6);
}

TEST(LoopOnAModalNode, ThatStaysOpenIsAnErrorWithTheGap) {
  const BodyFiles files = known_files(test_support::modal_answers());
  const auto fault = [&](VirtualBodies treatment) -> std::string {
    try {
      Simulation run(loop(treatment, 0.003), files);
      run.start();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(fault(VirtualBodies::eliminate),
              ::testing::HasSubstr("'loop' closes stays open by a distance of 0.003 and an angle of 0 rad"));
  EXPECT_THAT(fault(VirtualBodies::keep), ::testing::HasSubstr("0.003"));
}

}  // namespace
}  // namespace tisserand::mechanism::virtual_modal_test

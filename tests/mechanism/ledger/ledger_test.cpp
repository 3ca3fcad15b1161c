// SPDX-License-Identifier: GPL-3.0-or-later
// Ledgers of motions whose changes and activities are known in closed form, and against two whole runs.
#include "mechanism/ledger/ledger.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

#include "common/error.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/ledger/table.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/switching/transfer.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::ledger_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::Simulation;
using ::testing::HasSubstr;

constexpr double g = 9.81;

/// Counts calls: times are positive and no clock is read.
RunControl counted() {
  RunControl control;
  control.clock = [calls = 0.0]() mutable { return calls += 1.0; };
  return control;
}

Ledger ledger_of(const formats::Scene& scene, const BodyFiles& files, const WindowChoice& windows,
                 const ToggleChoice& choice = {}, const std::vector<std::string>& channels = {}) {
  LedgerRequest request{scene};
  request.settings.windows = windows;
  request.settings.repeats = 1;
  request.settings.choice = choice;
  request.settings.channels = channels;
  return make_ledger(request, files, counted());
}

const LedgerLine& line_of(const Ledger& ledger, const std::string& effect, const std::string& becomes = "off") {
  for (const LedgerLine& line : ledger.lines)
    if (line.toggle.effect == effect && line.toggle.becomes == becomes) return line;
  throw std::runtime_error("no line " + effect);
}

constexpr double mass = 2.0, speed = 3.0, end = 1.0;

formats::Scene thrown() {
  formats::Scene scene = test_support::empty_scene(1.0 / 64.0, end);
  scene.gravity = {0, 0, -g};
  formats::RigidBodySpec ball = test_support::rigid_body("ball", mass, Vector3d::Zero(), {1, 1, 1});
  ball.start.velocity = Vector3d(speed, 0, 0);
  ball.start.angular_velocity = Vector3d::Zero();
  scene.bodies.emplace_back(ball);
  return scene;
}

// Without gravity the ball is ½ g t² away at the end of the run; its largest displacement is that at the end. The power
// m g·v = m g² t has the integral m g² T²/2, and the trapezoidal rule is exact for it.
TEST(Ledger, SizesGravityOfAThrownBall) {
  const Ledger ledger = ledger_of(thrown(), {}, {1, 1.0}, {{"gravity"}, {}});
  ASSERT_EQ(ledger.lines.size(), 1U);
  const LedgerLine& line = ledger.lines[0];
  const double fall = 0.5 * g * end * end;
  ASSERT_EQ(line.failure, "");
  ASSERT_EQ(line.changes.size(), 1U);
  EXPECT_EQ(line.changes[0].of, "nodes/position/ball");
  EXPECT_NEAR(line.changes[0].part, fall / std::hypot(fall, speed * end), 1e-9);
  EXPECT_NEAR(line.activity.value(), mass * g * fall, 1e-9 * mass * g * fall);
  EXPECT_EQ(line.share, 1.0);
}

// Each window begins with the state of the run: the ball falls ½ g L² further in each, L the length of a window.
TEST(Ledger, WindowsBeginWithTheStatesOfTheRun) {
  const Ledger ledger = ledger_of(thrown(), {}, {4, 0.5}, {{"gravity"}, {}});
  const double L = end / 8.0, fall = 0.5 * g * end * end;
  EXPECT_EQ(ledger.windows, 4);
  EXPECT_DOUBLE_EQ(ledger.window, L);
  EXPECT_NEAR(line_of(ledger, "gravity").changes.at(0).part, 0.5 * g * L * L / std::hypot(fall, speed * end), 1e-9);
  // ∫ m g² t dt over the windows [i/4, i/4 + 1/8]
  double activity = 0.0;
  for (int i = 0; i < 4; ++i) activity += mass * g * g * 0.5 * (std::pow(0.25 * i + L, 2) - std::pow(0.25 * i, 2));
  EXPECT_NEAR(line_of(ledger, "gravity").activity.value(), activity, 1e-9 * activity);
}

// A channel is compared with its own largest value: z with ½ g T², of which all is gone.
TEST(Ledger, ComparesChannelsThatAreNamed) {
  const Ledger ledger = ledger_of(thrown(), {}, {1, 1.0}, {{"gravity"}, {}}, {"nodes/position/ball/z"});
  EXPECT_EQ(ledger.lines[0].changes.at(0).of, "nodes/position/ball/z");
  EXPECT_NEAR(ledger.lines[0].changes.at(0).part, 1.0, 1e-9);
}

// A block slides with μ m g against it: activity is the energy that friction takes, half of the kinetic energy less
// what is left, and without it the block is ½ μ g t² further.
TEST(Ledger, SizesFrictionByTheWorkThatItTakes) {
  constexpr double mu = 0.1;
  formats::Scene scene = thrown();
  scene.joints = {test_support::joint("slide", JointKind::prismatic, "ground", "ball", Vector3d::Zero(), {1, 0, 0})};
  scene.joints[0].friction = formats::FrictionSpec{mu, std::nullopt, 1e-6, 0.0, std::nullopt};
  const Ledger ledger = ledger_of(scene, {}, {1, 1.0}, {{"friction"}, {}});
  const double x = speed * end - 0.5 * mu * g * end * end;
  const LedgerLine& line = line_of(ledger, "friction");
  EXPECT_NEAR(line.activity.value(), mu * mass * g * x, 1e-4 * mu * mass * g * x);
  const auto position = std::ranges::find(line.changes, "nodes/position/ball", &LedgerChange::of);
  ASSERT_NE(position, line.changes.end());
  EXPECT_NEAR(position->part, 0.5 * mu * g * end * end / x, 1e-6);
}

TEST(Ledger, GyroscopicTermsDoNoWorkAndAreTried) {
  formats::Scene scene = test_support::empty_scene(0.01, 1.0);
  formats::RigidBodySpec top = test_support::rigid_body("top", 1.0, Vector3d::Zero(), {1, 2, 3});
  top.start.angular_velocity = Vector3d(3, 4, 5);
  scene.bodies.emplace_back(top);
  const Ledger ledger = ledger_of(scene, {}, {1, 1.0}, {}, {"nodes/angular_velocity/top"});
  const LedgerLine& line = line_of(ledger, "gyroscopic");
  EXPECT_FALSE(line.activity.has_value());
  EXPECT_TRUE(line.replayed);
  EXPECT_GT(line.changes.at(0).part, 0.1);
  // Its centre stays, its axes turn otherwise: seen without a channel too.
  const Ledger unnamed = ledger_of(scene, {}, {1, 1.0}, {}, {});
  EXPECT_THAT(line_of(unnamed, "gyroscopic").changes.at(0).of, ::testing::HasSubstr("of top"));
  EXPECT_GT(line_of(unnamed, "gyroscopic").changes.at(0).part, 0.1);
}

/// A slender beam with a companion that turns about its end under a force along it.
formats::Scene turning_beam() {
  formats::Scene scene = test_support::empty_scene(2e-3, 0.2);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  scene.joints = {test_support::joint("hinge", JointKind::revolute, "ground", "beam/n0", Vector3d::Zero(), {0, 0, 1})};
  scene.motions = {test_support::drive("hinge", "5 * t")};
  scene.loads = {test_support::constant_load("side", formats::LoadKind::force, "beam/n4", {0, 3, 0})};
  return scene;
}

BodyFiles beam_files() {
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(1e4), 1.0, 4);
  return test_support::files_of(test_support::second_order_beam(beam, {0, 4}, 2));
}

Vector3d tip_after(formats::Scene scene, const std::vector<formats::EffectSwitch>& switches, const BodyFiles& files) {
  scene.effects = switches;
  Simulation run(scene, files);
  run.start();
  run.run(scene.integrator.end);
  return run.position("beam/n4");
}

// The whole run as one window: the change of a channel at its largest is no less than that of its last value in two
// runs.
TEST(Ledger, OfTheWholeRunAgreesWithTwoRuns) {
  const BodyFiles files = beam_files();
  const formats::Scene scene = turning_beam();
  formats::Scene ends = scene;
  const Ledger ledger = ledger_of(scene, files, {1, 1.0}, {{"stiffening"}, {}}, {"nodes/position/beam/n4/x"});
  const double last = std::abs(tip_after(scene, {}, files).x() -
                               tip_after(scene, {{formats::Effect::stiffening, "", false, ""}}, files).x());
  EXPECT_GT(last, 0.0);
  EXPECT_GE(ledger.lines.at(0).changes.at(0).part, 0.999 * last);  // of |x| ≤ 1 or a little more
  EXPECT_LT(ledger.lines.at(0).changes.at(0).part, 1.0);
}

TEST(Ledger, TellsWhichInertiaIsRight) {
  const Ledger ledger = ledger_of(turning_beam(), beam_files(), {2, 0.5}, {{"inertia"}, {}});
  EXPECT_EQ(ledger.lines.size(), 3U);  // A, B and M in place of F
  for (const LedgerLine& line : ledger.lines) {
    EXPECT_EQ(line.toggle.is, "F");
    EXPECT_EQ(line.failure, "");
    EXPECT_EQ(line.from_best, line.changes.at(0).part);  // the scene has F
  }
  ASSERT_EQ(ledger.verdicts.size(), 1U);
  EXPECT_THAT(ledger.verdicts[0],
              ::testing::AllOf(HasSubstr("difference from F, which contains all of the mass: "), HasSubstr(". Use ")));
}

// What could be on is tried too: a superelement that is used as a rigid body, and one without its companion.
TEST(Ledger, TriesWhatTheSceneDoesWithout) {
  formats::Scene scene = turning_beam();
  std::get<formats::SuperelementBodySpec>(scene.bodies[0]).second_order = false;
  const Ledger linear = ledger_of(scene, beam_files(), {2, 0.5}, {{"stiffening"}, {}});
  EXPECT_EQ(line_of(linear, "stiffening", "on").toggle.with, "inertia F in place of B");
  EXPECT_EQ(line_of(linear, "stiffening", "on").failure, "");

  std::get<formats::SuperelementBodySpec>(scene.bodies[0]).second_order.reset();
  std::get<formats::SuperelementBodySpec>(scene.bodies[0]).rigid = true;
  const Ledger rigid = ledger_of(scene, beam_files(), {2, 0.5}, {{"flexibility"}, {}});
  EXPECT_EQ(line_of(rigid, "flexibility", "on").failure, "");
  EXPECT_GT(line_of(rigid, "flexibility", "on").changes.at(0).part, 0.0);
}

TEST(Ledger, SwitchesOfTheSceneDoNotStandAgainstWhatIsTried) {
  formats::Scene scene = turning_beam();
  scene.effects = {{formats::Effect::stiffening, "", false, "test"}};
  const Ledger ledger = ledger_of(scene, beam_files(), {2, 0.5}, {{"inertia"}, {}});
  EXPECT_EQ(ledger.lines.size(), 3U);
  for (const LedgerLine& line : ledger.lines) {
    EXPECT_EQ(line.failure, "") << line.toggle.becomes;
    EXPECT_TRUE(line.whole_run);
  }
}

// The flexible beam bends under the side force, the rigid one keeps its ends on a line: all of the deflection is gone.
TEST(Ledger, WithoutFlexibilityTheDeflectionIsGone) {
  formats::Scene scene = turning_beam();
  scene.integrator.end = 40 * scene.integrator.step;  // each of which is a row, so that none is larger between rows
  const Ledger ledger = ledger_of(scene, beam_files(), {1, 1.0}, {{"flexibility"}, {}});
  const LedgerLine& line = line_of(ledger, "flexibility");
  ASSERT_EQ(line.failure, "");
  EXPECT_EQ(line.changes.at(0).of, "deflection of beam/n4");
  EXPECT_NEAR(line.changes.at(0).part, 1.0, 1e-9);  // of a beam that begins undeformed
  EXPECT_GT(line.activity.value(), 0.0);
}

/// Linear momentum and angular momentum about the origin.
Eigen::Matrix<double, 6, 1> momenta_of(const RigidBody& body, const NodeMotion& node) {
  Eigen::Matrix<double, 6, 1> momenta;
  momenta.head<3>() = body.mass * node.xd;
  momenta.tail<3>() = node.x.cross(momenta.head<3>()) + node.R * (body.inertia * node.Omega);
  return momenta;
}

// A superelement that moves as a rigid body has the momenta of the rigid body that it becomes, and back.
TEST(Transfer, KeepsRigidMotionForthAndBack) {
  SuperelementFiles files;
  test_support::add_file("bar", test_support::beam_superelement({}), files);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  formats::SuperelementBodySpec bar = test_support::superelement_body("bar", "bar");
  bar.start.pose.position = {1, 2, 3};
  bar.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 2).normalized()));
  bar.start.velocity = Vector3d(1, -2, 0.5);
  bar.start.angular_velocity = Vector3d(0.3, 0.2, -1);
  scene.bodies.emplace_back(bar);
  const BuiltModel flexible = build_model(scene, files);
  std::get<formats::SuperelementBodySpec>(scene.bodies[0]).rigid = true;
  const BuiltModel rigid = build_model(scene, files);

  EXPECT_FALSE(share_states(flexible.model, rigid.model));
  const State forth = transfer(flexible.model, flexible.state, rigid.model);
  EXPECT_LT((forth.x() - rigid.state.x()).norm(), 1e-13);
  EXPECT_LT((forth.v() - rigid.state.v()).norm(), 1e-12);
  Evaluation now(rigid.model), then(rigid.model);
  evaluate(rigid.model, forth, now);
  evaluate(rigid.model, rigid.state, then);
  const RigidBody& body = rigid.model.rigid_bodies[0];
  const auto expected = momenta_of(body, then.motion[0]);
  EXPECT_LT((momenta_of(body, now.motion[0]) - expected).norm(), 1e-12 * expected.norm());

  const State back = transfer(rigid.model, forth, flexible.model);
  EXPECT_LT((back.x() - flexible.state.x()).norm(), 1e-13);
  EXPECT_LT((back.v() - flexible.state.v()).norm(), 1e-12);
}

// Its ends pulled apart symmetrically: no momentum, so that the rigid body rests where the middle is.
TEST(Transfer, LeavesDeformationBehind) {
  SuperelementFiles files;
  test_support::add_file("bar", test_support::beam_superelement({}), files);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.emplace_back(test_support::superelement_body("bar", "bar"));
  BuiltModel flexible = build_model(scene, files);
  flexible.state.x().col(0).x() -= 1e-3;
  flexible.state.x().col(1).x() += 1e-3;
  flexible.state.v()[flexible.model.nodes[0].translation] = -0.1;
  flexible.state.v()[flexible.model.nodes[1].translation] = 0.1;
  std::get<formats::SuperelementBodySpec>(scene.bodies[0]).rigid = true;
  const BuiltModel rigid = build_model(scene, files);
  const State state = transfer(flexible.model, flexible.state, rigid.model);
  EXPECT_LT((state.x().col(0) - Vector3d(1, 0, 0)).norm(), 1e-13);  // half of BeamData::length
  EXPECT_LT(state.v().norm(), 1e-13);
}

std::string error_of(const formats::Scene& scene, const ToggleChoice& choice,
                     const std::vector<std::string>& channels) {
  try {
    (void)ledger_of(scene, {}, {1, 1.0}, choice, channels);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Ledger, SaysWhatIsWrongWithTheRequest) {
  EXPECT_THAT(error_of(thrown(), {{"gravty"}, {}}, {}), HasSubstr("no effect 'gravty'; did you mean 'gravity'?"));
  EXPECT_THAT(error_of(thrown(), {{}, {"bal"}}, {}), HasSubstr("no body, joint or spring 'bal'; did you mean 'ball'?"));
  EXPECT_THAT(error_of(thrown(), {{"damping"}, {}}, {}), HasSubstr("the scene has no effect that can be switched"));
  EXPECT_THAT(error_of(thrown(), {}, {"nodes/position/bal/z"}),
              HasSubstr("there is no channel 'nodes/position/bal/z'"));
  formats::Scene at_rest = thrown();
  at_rest.analysis = formats::AnalysisKind::statics;
  EXPECT_THAT(error_of(at_rest, {}, {}), HasSubstr("a dynamics analysis"));
  formats::Scene accurate = thrown();
  accurate.integrator.accuracy.emplace();
  EXPECT_THAT(error_of(accurate, {}, {}), HasSubstr("set integrator.step or error_control"));
}

// Results of the scene before its ball was made heavier: nodes agree, and only the stored text can tell.
TEST(Ledger, DoubtsResultsOfAnotherScene) {
  const test_support::TemporaryFolder folder;
  const std::string file = folder.file("ball.scene.yaml"), results = folder.file("ball.results.h5");
  std::ofstream(file) << "scene: ball\ngravity: [0, 0, -9.81]\n"
                         "bodies: {ball: {type: rigid, mass: 2, inertia: [1, 1, 1]}}\n"
                         "integrator: {step: 0.01, end: 0.5}\n";
  simulate(formats::read_scene(file, {}), results, {});
  const auto doubt_of = [&](const std::vector<formats::Override>& overrides) {
    LedgerRequest request{formats::read_scene(file, overrides)};
    request.settings.results = results;
    request.settings.repeats = 1;
    return make_ledger(request, {}, counted()).doubt;
  };
  EXPECT_EQ(doubt_of({}), "");
  EXPECT_THAT(doubt_of({{"bodies.ball.mass", "3"}}),
              ::testing::AllOf(HasSubstr("another scene"), HasSubstr("mass: 2"), HasSubstr("mass: 3")));
}

TEST(Ledger, IsReportedInLinesAndInJson) {
  const Ledger ledger = ledger_of(thrown(), {}, {1, 1.0});
  const std::string text = ledger_text(ledger, Units::si());
  EXPECT_THAT(text, HasSubstr("gravity of 'ball': on; off would change nodes/position/ball by 85 %"));
  EXPECT_THAT(text, HasSubstr("gyroscopic of 'ball': on; off would change nodes/position/ball by"));
  const auto json = nlohmann::json::parse(ledger_json(ledger));
  ASSERT_EQ(json["effects"].size(), 2U);
  EXPECT_EQ(json["effects"][0]["effect"], "gravity");
  EXPECT_EQ(json["effects"][0]["becomes"], "off");
  EXPECT_NEAR(json["effects"][0]["changes"][0]["part"].get<double>(), 0.8531, 1e-3);  // 4.905/5.749
  EXPECT_TRUE(json["effects"][0].contains("cost_per_step"));
}

/// Begins slowly, as a results file that has to be created.
class SlowToBegin : public RunListener {
 public:
  explicit SlowToBegin(double& time) : time_(time) {}
  void begin(const formats::ResultsLayout&) override { time_ += 100.0; }
  void row(const formats::ResultsRow&) override { time_ += 1.0; }
  void end(RunReport&) override {}

 private:
  double& time_;
};

// Else steps seem to cost what only the beginning of a run does, and costs of short runs are of nothing else.
TEST(RunSeconds, CountTheBeginningOfTheResultsAsOutput) {
  double time = 0.0;
  RunControl control;
  control.clock = [&time] { return time; };
  const BodyFiles files;
  RunRequest request{thrown(), files, std::nullopt, "", "", std::nullopt};
  SlowToBegin listener(time);
  request.listener = &listener;
  const RunReport report = simulate(request, control).report;
  EXPECT_EQ(report.seconds_output, 100.0 + static_cast<double>(report.rows));
  EXPECT_EQ(report.seconds_steps, 0.0);
  EXPECT_EQ(report.seconds_start, 0.0);
}

}  // namespace
}  // namespace tisserand::mechanism::ledger_test

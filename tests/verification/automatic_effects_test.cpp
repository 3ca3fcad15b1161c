// Runs that switch effects by themselves: what never switches is the fixed scene, what switches stays within the
// tolerance, results and checkpoints know nothing of it, what sleeps is not there.
#include <cmath>
#include <filesystem>
#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/results/results.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/run/run.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"
#include "tests/support/scenes/swing.hpp"
#include "tests/support/stored_motion.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::automatic_effects_test {
namespace {

using Eigen::Vector3d;
using formats::Effect;
using formats::JointKind;
using test_support::largest_difference;
using test_support::largest_value;
using test_support::TemporaryFolder;
using ::testing::HasSubstr;

const Vector3d z = Vector3d::UnitZ();

BodyFiles files() {
  BodyFiles list;
  test_support::add_file("beam", test_support::craig_bampton_beam({}, 3), list.superelements);
  test_support::BeamData stout;
  stout.Iy = stout.Iz = 1e-6;
  test_support::add_file("stout", test_support::craig_bampton_beam(stout, 3), list.superelements);
  return list;
}

formats::EffectSwitch automatic(Effect effect, const std::string& body = "") {
  return {effect, body, true, "switch", true};
}
formats::EffectSwitch fixed(Effect effect, bool on) { return {effect, "", on, "switch"}; }

/// A beam on a hinge that a moment turns from 0.1 to 0.4, with a bob on a ball joint at its tip. Its first frequency is
/// about 20 Hz, and it is damped; `moment` 300 bends it by some thousandths of its length.
formats::Scene swing(double moment) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.2);
  formats::SuperelementBodySpec beam = test_support::superelement_body("beam", "beam");
  beam.damping.ratio = 0.3;
  scene.bodies.emplace_back(beam);
  test_support::hang(scene, "beam/base", "beam/tip", moment);
  return scene;
}

/// A stout beam with the bob that falls about the hinge: it bends by some millionths of its length, and its first
/// frequency is over a hundred times that of the pendulum.
formats::Scene pendulum() {
  formats::Scene scene = swing(0.0);
  std::get<formats::SuperelementBodySpec>(scene.bodies[0]).file = "stout";
  scene.springs.clear();
  scene.gravity = {0, -9.81, 0};
  return scene;
}

formats::Scene with(formats::Scene scene, const std::vector<formats::EffectSwitch>& effects) {
  scene.effects = effects;
  return scene;
}

RunReport run(const formats::Scene& scene, const std::string& path) {
  const BodyFiles list = files();
  return simulate(RunRequest{scene, list, std::nullopt, path, "", std::nullopt}, {}).report;
}

const std::vector<std::string> motion = {"nodes/position/beam/tip/*",
                                         "nodes/rotation/beam/tip/*",
                                         "nodes/velocity/beam/base/*",
                                         "nodes/acceleration/beam/tip/*",
                                         "nodes/*/bob/*",
                                         "joints"};

// Asleep throughout. The rigid scene calls the same places by the same names.
TEST(AutomaticEffects, ThatSleepThroughoutAreTheRigidSceneToTheBit) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
  const RunReport report = run(with(pendulum(), {automatic(Effect::flexibility)}), a);
  run(with(pendulum(), {fixed(Effect::flexibility, false)}), b);
  ASSERT_EQ(report.automatic.size(), 1U);
  EXPECT_FALSE(report.automatic[0].was_awake);
  EXPECT_TRUE(report.automatic[0].changes.empty());
  EXPECT_EQ(report.automatic[0].part_on, 0.0);
  EXPECT_GT(largest_value(b, {"joints/rate"}), 1.0);
  EXPECT_EQ(largest_difference(a, b, motion), 0.0);
  EXPECT_EQ(largest_difference(a, b, {"energy/kinetic", "energy/balance", "energy/work"}), 0.0);
  EXPECT_EQ(largest_value(a, {"energy/switched"}), 0.0);
  EXPECT_EQ(largest_value(a, {"superelements/y", "superelements/y_rate"}), 0.0);
}

// A moment that bends it from the start on, and a tolerance that never lets it sleep.
TEST(AutomaticEffects, ThatAreAwakeThroughoutAreTheFlexibleSceneToTheBit) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
  formats::Scene scene = swing(0.0);
  scene.springs[0].force = 300.0;
  scene.integrator.end = 0.3;
  formats::Scene own = with(scene, {automatic(Effect::flexibility)});
  own.automatic.tolerance = 1e-9;
  const RunReport report = run(own, a);
  run(scene, b);
  EXPECT_TRUE(report.automatic[0].was_awake);
  EXPECT_EQ(report.automatic[0].part_on, 1.0);
  EXPECT_EQ(largest_difference(a, b, {"nodes", "superelements", "joints", "forces", "energy/total"}), 0.0);
}

// Awake while the moment bends it. Positions to some tolerances (1e-3 of the size, 2): it falls asleep at a quarter of
// it and starts bent as the load asks. The rigid scene errs by more.
TEST(AutomaticEffects, WakeAndSleepWithinTheTolerance) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5"), c = folder.file("c.results.h5");
  const RunReport report = run(with(swing(300.0), {automatic(Effect::flexibility)}), a);
  run(swing(300.0), b);
  run(with(swing(300.0), {fixed(Effect::flexibility, false)}), c);
  ASSERT_EQ(report.outcome, RunOutcome::completed) << report.reason;
  const SwitchHistory& history = report.automatic[0];
  EXPECT_FALSE(history.was_awake);
  ASSERT_GE(history.changes.size(), 2U);
  EXPECT_GE(history.changes[0], 0.079);  // the load begins at the edge of a window
  EXPECT_LT(history.changes[0], 0.2);
  EXPECT_GT(history.changes[1], 0.4);
  EXPECT_GT(report.repeated, 0);
  EXPECT_GT(history.part_on, 0.1);
  EXPECT_LT(history.part_on, 0.9);
  const double error = largest_difference(a, b, {"nodes/position"}), rigid = largest_difference(c, b, {"joints/force"});
  EXPECT_LT(error, 4e-3);
  EXPECT_LT(largest_difference(a, b, {"joints/force"}), 0.02 * largest_value(b, {"joints/force"}));
  EXPECT_GT(rigid, 0.02 * largest_value(b, {"joints/force"}));
  // What switches cost is told, within the part of the energy that is allowed, and the balance closes with it.
  const double energy = largest_value(a, {"energy/kinetic"});
  EXPECT_GT(largest_value(a, {"energy/switched"}), 0.0);
  EXPECT_LT(largest_value(a, {"energy/switched"}), 1e-3 * energy * static_cast<double>(history.changes.size()));
  EXPECT_LT(largest_value(a, {"energy/balance"}), 2.0 * largest_value(b, {"energy/balance"}) + 1e-4 * energy);
}

// A piece that falls asleep shakes what is welded to it, which no criterion of the piece alone sees; alone it is
// silent.
TEST(AutomaticEffects, PiecesOfAWeldThatSleepAreDoubted) {
  const auto doubts_of = [](const formats::Scene& scene) {
    TemporaryFolder folder;
    const RunReport report = run(with(scene, {automatic(Effect::flexibility)}), folder.file("a.results.h5"));
    EXPECT_GE(report.automatic.back().changes.size(), 1U);  // asleep at times
    return fmt::format("{}", fmt::join(report.doubts, "\n"));
  };
  formats::Scene two = swing(300.0);
  formats::SuperelementBodySpec second = test_support::superelement_body("second", "stout");
  second.start.pose.position = {2, 0, 0};
  two.bodies.emplace_back(second);
  two.joints.push_back(test_support::joint("weld", JointKind::fixed, "beam/tip", "second/base", {2, 0, 0}, z));
  EXPECT_THAT(doubts_of(two), HasSubstr("second fell asleep welded to flexible bodies"));
  EXPECT_THAT(doubts_of(swing(300.0)), ::testing::Not(HasSubstr("welded")));
}

// The layout is that of the scene with all on, but for what switches cost; and so are the names of channels.
TEST(AutomaticEffects, KeepTheLayoutOfResults) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
  run(with(swing(300.0), {automatic(Effect::flexibility)}), a);
  run(swing(300.0), b);
  std::vector<std::string> own, other;
  const formats::ResultsReader switching(a), always(b);
  for (const formats::Channel& channel : switching.channels())
    if (channel.name != "energy/switched") own.push_back(channel.name);
  for (const formats::Channel& channel : always.channels()) other.push_back(channel.name);
  EXPECT_EQ(own, other);
  EXPECT_EQ(formats::ResultsReader(a).rows(), formats::ResultsReader(b).rows());
  EXPECT_EQ(formats::ResultsReader(a).time(), formats::ResultsReader(b).time());
}

// Of a rigid body too the forces on its nodes are those of its joints: at the tip the ball joint's.
TEST(AutomaticEffects, TellWhatNodesOfASleepingBodyReceive) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5");
  run(with(pendulum(), {automatic(Effect::flexibility)}), a);
  // Of the bob, whose mass is 1, and its weight.
  const double force = largest_value(a, {"nodes/acceleration/bob/*"});
  ASSERT_GT(force, 9.0);
  EXPECT_EQ(largest_value(a, {"superelements/y"}), 0.0);
  const Eigen::MatrixXd received = test_support::stored_rows(a, {"superelements/boundary_force/beam/tip/force_*"});
  Eigen::MatrixXd needed = test_support::stored_rows(a, {"nodes/acceleration/bob/*"});
  needed.col(1).array() += 9.81;
  EXPECT_LT((received + needed).cwiseAbs().maxCoeff(), 1e-6 * force);  // Newton's iteration ends at 1e-8
}

/// A clamped beam with a load across its tip that grows from 0.4 to 2 tolerances of 1e-3 of its length.
struct GrowingLoad {
  test_support::BeamData beam;
  double force = 4e-4 * 3.0 * beam.young * beam.Iz / (beam.length * beam.length);  ///< at t = 0
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);

  GrowingLoad() {
    scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
    scene.joints = {test_support::joint("clamp", JointKind::fixed, "ground", "beam/base", Vector3d::Zero(), z)};
    formats::LoadSpec load = test_support::constant_load("tip", formats::LoadKind::force, "beam/tip", Vector3d::Zero());
    load.components[1] = formats::TimeExpression{fmt::format("{} * (1 + 4 * t)", force), {}, "here"};
    scene.loads = {load};
  }
};

/// The checkpoint of a run that is written first after `interval`, whether the run that goes on from it ends in the
/// same state, and when effects woke or fell asleep in the whole run.
std::vector<double> expect_bit_equal(formats::Scene scene, double interval) {
  TemporaryFolder folder;
  const BodyFiles list = files();
  scene.checkpoint.interval = interval;
  const std::string kept = folder.file("kept.h5");
  RunControl control;
  control.progress = [&](double) {
    const std::string written = folder.file("a.checkpoint.h5");
    if (std::filesystem::exists(written) && !std::filesystem::exists(kept)) std::filesystem::copy_file(written, kept);
  };
  const RunEnd whole =
      simulate(RunRequest{scene, list, std::nullopt, folder.file("a.results.h5"), "", std::nullopt}, control);
  const RunEnd rest =
      simulate(RunRequest{scene, list, std::nullopt, folder.file("b.results.h5"), kept, std::nullopt}, {});
  EXPECT_GE(rest.report.automatic[0].changes.size(), 1U);
  EXPECT_LT(rest.report.steps, whole.report.steps);
  EXPECT_EQ(rest.state.block(), whole.state.block());
  EXPECT_GT(rest.state.v().norm(), 0.0);
  return whole.report.automatic[0].changes;
}

// As of a run without switches (checkpoint_test.cpp), through the switch that wakes and the one that lets sleep; and
// from where it wakes with a rate, of which the window before knows a half.
TEST(AutomaticEffects, GoOnFromACheckpointBitEqual) {
  const formats::Scene scene = with(swing(300.0), {automatic(Effect::flexibility)});
  for (const double at : {0.05, 0.25}) EXPECT_GE(expect_bit_equal(scene, at).size(), 2U);
  const formats::Scene growing = with(GrowingLoad().scene, {automatic(Effect::flexibility)});
  const std::vector<double> changes = expect_bit_equal(growing, 0.1);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(expect_bit_equal(growing, changes[0] - 0.5e-3), changes);  // of the window that ends there
}

// From a stored instant at which the body is rigid it goes on rigid, where it is flexible flexible.
TEST(AutomaticEffects, GoOnFromAStoredInstant) {
  TemporaryFolder folder;
  const BodyFiles list = files();
  const formats::Scene scene = with(swing(300.0), {automatic(Effect::flexibility)});
  const RunEnd whole =
      simulate(RunRequest{scene, list, std::nullopt, folder.file("a.results.h5"), "", std::nullopt}, {});
  for (const double at : {0.05, 0.25}) {
    RunRequest again{scene, list, std::nullopt, folder.file("b.results.h5"), folder.file("a.results.h5"), at};
    const RunEnd rest = simulate(again, {});
    EXPECT_EQ(rest.report.automatic[0].was_awake, at > 0.1);
    EXPECT_LT((rest.state.x() - whole.state.x()).cwiseAbs().maxCoeff(), 4e-3);
  }
}

// Pools, coordinates and pattern of the model that runs are those of the scene without the effect.
TEST(AutomaticEffects, ThatSleepAreNotInTheModel) {
  const BodyFiles list = files();
  const formats::Scene scene = with(pendulum(), {automatic(Effect::flexibility)});
  const RunControl control;
  mechanism::Run sleeping(scene, list, control);
  start(sleeping);
  static_cast<void>(begin_rows(sleeping, list));
  const Model rigid = build_model(with(pendulum(), {fixed(Effect::flexibility, false)}), list).model;
  const Model& model = sleeping.built.model;
  EXPECT_TRUE(model.superelements.empty());
  EXPECT_TRUE(model.superelement_bodies.empty());
  EXPECT_EQ(model.rigid_bodies.size(), rigid.rigid_bodies.size());
  EXPECT_EQ(model.sizes.velocities(), rigid.sizes.velocities());
  EXPECT_EQ(model.pattern->nonzeros(), rigid.pattern->nonzeros());
  EXPECT_EQ(sleeping.whole().model.superelements.size(), 1U);
}

/// A slender beam of second order that its hinge spins up: stiffening holds it straight, without it bends away.
formats::Scene spin_up() {
  formats::Scene scene = test_support::empty_scene(2e-3, 2.0);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  scene.joints = {test_support::joint("hinge", JointKind::revolute, "ground", "beam/n0", Vector3d::Zero(), z)};
  scene.motions = {test_support::drive("hinge", "t < 1 ? 2 * t^2 : 4 * t - 2", {1.0})};
  return scene;
}

TEST(AutomaticEffects, StiffeningWakesWhereABeamSpins) {
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(1e4), 1.0, 4);
  const BodyFiles list = test_support::files_of(test_support::second_order_beam(beam, {0, 4}, 2));
  TemporaryFolder folder;
  const auto end_of = [&](formats::Scene scene, const std::vector<formats::EffectSwitch>& effects) {
    scene.effects = effects;
    return simulate(RunRequest{scene, list, std::nullopt, "", "", std::nullopt}, {});
  };
  const RunEnd whole = end_of(spin_up(), {}), own = end_of(spin_up(), {automatic(Effect::stiffening)});
  ASSERT_EQ(own.report.automatic.size(), 1U);
  EXPECT_FALSE(own.report.automatic[0].was_awake);  // it begins straight
  EXPECT_LT((own.state.x() - whole.state.x()).cwiseAbs().maxCoeff(), 2e-3);
}

// While forces grow from nothing, what its inertia does to them is a large part of what they are and a small one of
// what they become: of a force that goes with t², 2/(ω t)², with ω t about 40 where twenty windows end.
TEST(AutomaticEffects, SleepWhereForcesGrowFromNothing) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
  formats::Scene scene = pendulum();
  scene.gravity.setZero();
  scene.integrator.end = 0.8;
  scene.motions = {test_support::drive("hinge", "2 * t^4")};
  const RunReport report = run(with(scene, {automatic(Effect::flexibility)}), a);
  run(scene, b);
  EXPECT_FALSE(report.automatic[0].was_awake);
  EXPECT_TRUE(report.automatic[0].changes.empty());
  EXPECT_GT(largest_value(b, {"joints/force"}), 10.0);
  EXPECT_LT(largest_difference(a, b, {"joints/force"}), 1e-3 * largest_value(b, {"joints/force"}));
}

// It rests, and no energy is there beside that of its deformation; yet it begins with what the load asks for: its clamp
// goes on to feel the load times the length. From rest it would tremble by the rate of the load over the frequency of
// the cantilever, 4/omega here; it begins with the rate that the load asks for, and trembles by a twentieth of that.
TEST(AutomaticEffects, WakeBentWhereNothingMoves) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5");
  const GrowingLoad growing;
  const test_support::BeamData& beam = growing.beam;
  const double force = growing.force;
  const RunReport report = run(with(growing.scene, {automatic(Effect::flexibility)}), a);
  EXPECT_FALSE(report.automatic[0].was_awake);
  ASSERT_EQ(report.automatic[0].changes.size(), 1U);
  EXPECT_NEAR(report.automatic[0].changes[0], 0.375, 0.02);  // 0.4 (1 + 4 t) = 1, at the edge of a window
  EXPECT_GT(largest_value(a, {"energy/switched"}), 0.0);
  const double omega =
      1.8751 * 1.8751 / (beam.length * beam.length) * std::sqrt(beam.young * beam.Iz / (beam.density * beam.area));
  const Eigen::VectorXd moment = test_support::stored_rows(a, {"joints/moment/clamp/z"}).col(0).cwiseAbs();
  const std::vector<double> time = formats::ResultsReader(a).time();
  for (std::size_t i = 0; i < time.size(); ++i)
    EXPECT_NEAR(moment[static_cast<Eigen::Index>(i)], force * (1.0 + 4.0 * time[i]) * beam.length,
                0.05 * 4.0 / omega * force * beam.length);
}

/// A beam that stands on a slide along y.
formats::Scene shaken(double amplitude, double omega) {
  formats::Scene scene = test_support::empty_scene(1e-3, 3.0);
  formats::SuperelementBodySpec beam = test_support::superelement_body("beam", "beam");
  beam.damping.ratio = 0.003;
  scene.bodies.emplace_back(beam);
  scene.bodies.emplace_back(test_support::rigid_body("foot", 1.0, Vector3d::Zero(), {0.1, 0.1, 0.1}));
  scene.joints = {test_support::joint("slide", JointKind::prismatic, "ground", "foot", Vector3d::Zero(), {0, 1, 0}),
                  test_support::joint("clamp", JointKind::fixed, "foot", "beam/base", Vector3d::Zero(), z)};
  scene.motions = {test_support::drive(
      "slide", fmt::format("{} * sin({} * t) * (t < 1 ? t^2 * (3 - 2 * t) : 1)", amplitude, omega), {1.0})};
  scene.gravity = {0, -9.81, 0};
  return scene;
}

// The frequency of a cantilever, [1.8751]² √(EI/(m l⁴)), is a sixth of that of the free beam, and its weight bends it
// five times more than what shakes it, which builds up to several tolerances. The scene that is whole from the start
// also trembles about its weight, by another tolerance or so.
TEST(AutomaticEffects, WakeAtAResonanceThatTheWeightHides) {
  const test_support::BeamData beam;
  const double omega =
      1.8751 * 1.8751 / (beam.length * beam.length) * std::sqrt(beam.young * beam.Iz / (beam.density * beam.area));
  formats::Scene scene = with(shaken(2e-3, omega), {automatic(Effect::flexibility)});
  scene.automatic.tolerance = 0.01;  // the weight takes three quarters of it
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5"), c = folder.file("c.results.h5");
  const RunReport report = run(scene, a);
  run(shaken(2e-3, omega), b);
  run(with(shaken(2e-3, omega), {fixed(Effect::flexibility, false)}), c);
  EXPECT_FALSE(report.automatic[0].was_awake);
  ASSERT_FALSE(report.automatic[0].changes.empty());
  const double tolerance = 0.01 * 2.0;
  EXPECT_LT(largest_difference(a, b, {"nodes/position/beam/tip/*"}), 2.0 * tolerance);
  EXPECT_GT(largest_difference(c, b, {"nodes/position/beam/tip/*"}), 3.0 * tolerance);
}

// Straight under its axial load it bends by nothing, and buckles. A tenth of the load of Euler, π² EI/l² with the
// weaker EI of 100, is reached at t = 0.1.
TEST(AutomaticEffects, WakeBeforeAColumnBuckles) {
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(1e5), 2.0, 8);
  const BodyFiles list = test_support::files_of(test_support::second_order_beam(beam, {0, 4, 8}, 6));
  formats::Scene scene = test_support::empty_scene(1e-3, 0.3);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  scene.bodies.emplace_back(test_support::rigid_body("block", 1.0, Vector3d::Zero(), {1, 1, 1}));
  scene.joints = {test_support::joint("clamp", JointKind::fixed, "ground", "beam/n0", Vector3d::Zero(), z),
                  test_support::joint("hold", JointKind::fixed, "ground", "block", Vector3d::Zero(), z)};
  scene.loads = {test_support::constant_load("axial", formats::LoadKind::force, "beam/n8", Vector3d::Zero()),
                 test_support::constant_load("other", formats::LoadKind::force, "block", {0, 1000, 0})};
  const double euler = EIGEN_PI * EIGEN_PI * 100.0 / 4.0;
  scene.loads[0].components[0] = formats::TimeTable{{0.0, 0.2, 1.0}, {0.0, -0.2 * euler, -0.2 * euler}};
  scene.effects = {automatic(Effect::flexibility), automatic(Effect::stiffening)};
  const RunReport report = simulate(RunRequest{scene, list, std::nullopt, "", "", std::nullopt}, {}).report;
  ASSERT_EQ(report.automatic.size(), 2U);
  for (const SwitchHistory& history : report.automatic) {
    EXPECT_FALSE(history.was_awake);
    ASSERT_EQ(history.changes.size(), 1U) << history.effect;
    EXPECT_NEAR(history.changes[0], 0.1, 0.021);  // at the edge of a window of 20 steps
  }
}

// Its internal coordinates rest at the equilibrium of a load on its tip, but the beam is bent: it stays so.
TEST(AutomaticEffects, KeepTheDeformationThatStaticsFound) {
  const BodyFiles list = files();
  formats::Scene scene = test_support::empty_scene(1e-3, 0.1);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  scene.joints = {test_support::joint("clamp", JointKind::fixed, "ground", "beam/base", Vector3d::Zero(), z)};
  scene.loads = {test_support::constant_load("tip", formats::LoadKind::force, "beam/tip", {0, 100, 0})};
  formats::Scene at_rest = scene;
  at_rest.analysis = formats::AnalysisKind::statics;
  const RunEnd bent = simulate(RunRequest{at_rest, list, std::nullopt, "", "", std::nullopt}, {});
  const RunEnd own =
      simulate(RunRequest{with(scene, {automatic(Effect::flexibility)}), list, bent.state, "", "", std::nullopt}, {});
  const double deflection = 100.0 * 8.0 / (3.0 * 2.1e11 * 2.0e-8);  // P l³/(3 EI)
  EXPECT_GT(bent.state.x().row(1).maxCoeff(), 0.9 * deflection);
  EXPECT_TRUE(own.report.automatic[0].was_awake);
  EXPECT_LT((own.state.x() - bent.state.x()).cwiseAbs().maxCoeff(), 1e-6 * deflection);
}

/// A beam on two hinges to ground about z, the second one turned by `angle` about x: no rigid beam moves then.
formats::Scene on_two_hinges(double angle) {
  formats::Scene scene = pendulum();
  scene.bodies.pop_back();
  scene.joints = {test_support::joint("left", JointKind::revolute, "ground", "beam/base", Vector3d::Zero(), z),
                  test_support::joint("right", JointKind::revolute, "ground", "beam/tip", {2, 0, 0},
                                      {0, std::sin(angle), std::cos(angle)})};
  scene.integrator.end = 0.1;
  scene = with(scene, {automatic(Effect::flexibility)});
  scene.automatic.tolerance = 0.1;  // its weight bends it by less
  return scene;
}

// Whether the axes are parallel, nearly so or not: there are rows beyond the rank of rigid motions in all of them.
TEST(AutomaticEffects, StayOnWhereReactionsStressABody) {
  const auto told = ::testing::Contains(HasSubstr("effects of beam stay on"));
  for (const double angle : {0.0, 1e-12, 1e-6, 0.1}) {
    SCOPED_TRACE(angle);
    TemporaryFolder folder;
    const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
    const RunReport report = run(on_two_hinges(angle), a);
    run(with(on_two_hinges(angle), {}), b);
    EXPECT_THAT(report.notes, told);
    EXPECT_EQ(report.automatic[0].part_on, 1.0);
    EXPECT_EQ(largest_difference(a, b, {"nodes", "joints", "superelements"}), 0.0);
  }
  const BodyFiles list = files();
  const formats::Scene scene = on_two_hinges(0.0);
  const RunControl control;
  mechanism::Run checked(scene, list, control);
  start(checked);
  checked.automatic->hold_stressed(checked);
  EXPECT_THAT(checked.report.notes, told);
  EXPECT_THAT(checked.report.automatic_rule,
              ::testing::AllOf(HasSubstr("flexibility of beam"), HasSubstr("tolerance 0.1"), HasSubstr("window 0.02")));
}

TEST(AutomaticEffects, SayNothingOfReactionsThatStressNoBody) {
  EXPECT_THAT(run(with(pendulum(), {automatic(Effect::flexibility)}), "").notes,
              ::testing::Not(::testing::Contains(HasSubstr("stay on"))));
}

std::string error_of(formats::Scene scene, const std::vector<formats::EffectSwitch>& effects) {
  scene.effects = effects;
  try {
    static_cast<void>(run(scene, ""));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(AutomaticEffects, AreRefusedWhereNothingCanBeSwitched) {
  EXPECT_THAT(error_of(swing(0.0), {automatic(Effect::stiffening, "beam")}),
              HasSubstr("body 'beam' has no stiffening to switch auto"));
  EXPECT_THAT(error_of(swing(0.0), {automatic(Effect::flexibility, "bob")}),
              HasSubstr("body 'bob' has no flexibility to switch auto"));
  formats::Scene scene = swing(0.0);
  scene.integrator.method = formats::Method::radau;
  EXPECT_THAT(error_of(scene, {automatic(Effect::flexibility)}),
              ::testing::AllOf(HasSubstr("generalised_alpha and hht"), HasSubstr("'on' and 'off'")));
}

}  // namespace
}  // namespace tisserand::mechanism::automatic_effects_test

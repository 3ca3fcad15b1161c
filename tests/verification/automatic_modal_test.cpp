// Runs that switch the flexibility of modal bodies by themselves, in each frame that modes can have.
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/results/results.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/swing.hpp"
#include "tests/support/stored_motion.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::automatic_modal_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::largest_difference;
using test_support::largest_value;
using test_support::TemporaryFolder;

const Vector3d z = Vector3d::UnitZ();

/// The same rod, ten modes each: hinged at its ends, of the mean of its mass, clamped at its first node; and one that
/// is stout, eleven modes.
BodyFiles files() {
  test_support::Rod rod{0.0, 2.0, 4.0e-4, 2.1e11, 8.0e10, 2.0e-8, 7800.0, 8};
  const test_support::LumpedModel slender = test_support::lumped_rod(rod);
  rod.I = 1e-6;
  const test_support::Conditions at_first_node{{0, 0, 0, 0, 0, 0}, {0, 1, 2, 3, 4, 5}};
  BodyFiles list;
  list.modal_bodies["hinged"].body = test_support::modal_body(slender, test_support::rod_conditions(8), 10);
  list.modal_bodies["mean"].body = test_support::modal_body(slender, {}, 10);
  list.modal_bodies["clamped"].body = test_support::modal_body(slender, at_first_node, 10);
  const test_support::LumpedModel stout = test_support::lumped_rod(rod);
  list.modal_bodies["stout"].body = test_support::modal_body(stout, test_support::rod_conditions(8), 11);
  list.modal_bodies["stout mean"].body = test_support::modal_body(stout, {}, 11);
  list.modal_bodies["stout clamped"].body = test_support::modal_body(stout, at_first_node, 11);
  return list;
}

/// A rod on a hinge that a moment of 300 turns from 0.1 to 0.4, with a bob on a ball joint at its tip. Its first
/// frequency is about 20 Hz, it is damped, and it bends by some thousandths of its length.
formats::Scene swing(const std::string& file) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.2);
  formats::ModalBodySpec rod = test_support::modal_spec("rod", file);
  rod.damping.ratio = 0.3;
  scene.bodies.push_back(rod);
  test_support::hang(scene, "rod/n0", "rod/n8", 300.0);
  return scene;
}

/// A stout rod that falls about the hinge with the bob: it bends by some millionths of its length.
formats::Scene pendulum() {
  formats::Scene scene = swing("stout");
  scene.springs.clear();
  scene.gravity = {0, -9.81, 0};
  return scene;
}

formats::Scene with_flexibility(formats::Scene scene, bool on, bool automatic) {
  scene.effects = {{formats::Effect::flexibility, "", on, "switch", automatic}};
  return scene;
}
formats::Scene automatic(formats::Scene scene) { return with_flexibility(std::move(scene), true, true); }
formats::Scene rigid(formats::Scene scene) { return with_flexibility(std::move(scene), false, false); }

RunEnd run(const formats::Scene& scene, const std::string& path) {
  const BodyFiles list = files();
  return simulate(RunRequest{scene, list, std::nullopt, path, "", std::nullopt}, {});
}

// A scene whose rod is too stout to matter is the one without its modes, and its modes are stored as they are: zero.
TEST(AutomaticModalBodies, ThatSleepThroughoutAreTheRigidSceneToTheBit) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
  const RunReport report = run(automatic(pendulum()), a).report;
  run(rigid(pendulum()), b);
  ASSERT_EQ(report.automatic.size(), 1U);
  EXPECT_FALSE(report.automatic[0].was_awake);
  EXPECT_EQ(report.automatic[0].part_on, 0.0);
  EXPECT_GT(largest_value(b, {"joints/rate"}), 1.0);
  for (const char* channels :
       {"nodes/position", "nodes/rotation", "nodes/velocity", "nodes/angular_velocity", "nodes/acceleration",
        "nodes/angular_acceleration", "joints", "energy/kinetic", "energy/balance"})
    EXPECT_EQ(largest_difference(a, b, {channels}), 0.0) << channels;
  EXPECT_EQ(largest_value(a, {"modal_bodies"}), 0.0);
  EXPECT_EQ(largest_value(a, {"energy/switched"}), 0.0);
}

TEST(AutomaticModalBodies, ThatAreAwakeThroughoutAreTheFlexibleSceneToTheBit) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
  formats::Scene scene = swing("hinged");
  scene.springs[0].force = 300.0;
  scene.integrator.end = 0.3;
  formats::Scene own = automatic(scene);
  own.automatic.tolerance = 1e-9;
  const RunReport report = run(own, a).report;
  run(scene, b);
  EXPECT_TRUE(report.automatic[0].was_awake);
  EXPECT_EQ(report.automatic[0].part_on, 1.0);
  EXPECT_EQ(largest_difference(a, b, {"nodes", "modal_bodies", "joints", "energy/total"}), 0.0);
}

// Awake while the moment bends it, whatever the frame of its modes. Positions to some tolerances (1e-3 of the size, 2),
// as of superelements (automatic_effects_test.cpp); without flexibility forces err by more.
TEST(AutomaticModalBodies, WakeAndSleepWithinTheTolerance) {
  for (const char* file : {"hinged", "mean", "clamped"}) {
    SCOPED_TRACE(file);
    TemporaryFolder folder;
    const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5"), c = folder.file("c.results.h5");
    const RunReport report = run(automatic(swing(file)), a).report;
    run(swing(file), b);
    run(rigid(swing(file)), c);
    ASSERT_EQ(report.outcome, RunOutcome::completed) << report.reason;
    EXPECT_THAT(report.doubts, ::testing::IsEmpty());
    const SwitchHistory& history = report.automatic[0];
    EXPECT_FALSE(history.was_awake);
    ASSERT_GE(history.changes.size(), 2U);
    EXPECT_GE(history.changes[0], 0.079);  // the load begins at the edge of a window
    EXPECT_LT(history.changes[0], 0.2);
    EXPECT_GT(history.changes[1], 0.4);
    EXPECT_LT(history.part_on, 0.9);
    const double force = largest_value(b, {"joints/force"}), energy = largest_value(a, {"energy/kinetic"});
    EXPECT_LT(largest_difference(a, b, {"nodes/position"}), 4e-3);
    EXPECT_LT(largest_difference(a, b, {"joints/force"}), 0.02 * force);
    EXPECT_GT(largest_difference(c, b, {"joints/force"}), 0.02 * force);
    EXPECT_GT(largest_value(a, {"energy/switched"}), 0.0);
    EXPECT_LT(largest_value(a, {"energy/switched"}), 1e-3 * energy * static_cast<double>(history.changes.size()));
    EXPECT_LT(largest_value(a, {"energy/balance"}), 2.0 * largest_value(b, {"energy/balance"}) + 1e-4 * energy);
  }
}

// From a checkpoint before and after the switch that wakes, to the bit; from stored instants with the bodies as they
// were there.
TEST(AutomaticModalBodies, GoOnFromWhereTheyStood) {
  const formats::Scene scene = automatic(swing("clamped"));
  for (const double at : {0.05, 0.25}) {
    TemporaryFolder folder;
    const BodyFiles list = files();
    formats::Scene kept_scene = scene;
    kept_scene.checkpoint.interval = at;
    const std::string kept = folder.file("kept.h5"), results = folder.file("a.results.h5");
    RunControl control;
    control.progress = [&](double) {
      const std::string written = folder.file("a.checkpoint.h5");
      if (std::filesystem::exists(written) && !std::filesystem::exists(kept)) std::filesystem::copy_file(written, kept);
    };
    const RunEnd whole = simulate(RunRequest{kept_scene, list, std::nullopt, results, "", std::nullopt}, control);
    const RunEnd rest =
        simulate(RunRequest{kept_scene, list, std::nullopt, folder.file("b.results.h5"), kept, std::nullopt}, {});
    EXPECT_GE(rest.report.automatic[0].changes.size(), 1U);
    EXPECT_LT(rest.report.steps, whole.report.steps);
    EXPECT_EQ(rest.report.mobility.coordinates, whole.report.mobility.coordinates);
    EXPECT_EQ(rest.report.mobility.degrees_of_freedom, whole.report.mobility.degrees_of_freedom);
    EXPECT_EQ(rest.state.block(), whole.state.block());
    const RunEnd again = simulate(RunRequest{scene, list, std::nullopt, folder.file("c.results.h5"), results, at}, {});
    EXPECT_EQ(again.report.automatic[0].was_awake, at > 0.1);
    EXPECT_LT((again.state.x() - whole.state.x()).cwiseAbs().maxCoeff(), 4e-3);
    // And where it sleeps after all that: what the start leaves of its rates is round-off.
    ASSERT_EQ(whole.report.automatic[0].changes.size() % 2, 0U);
    const double asleep = whole.report.automatic[0].changes.back() + 0.05;
    const RunEnd last =
        simulate(RunRequest{scene, list, std::nullopt, folder.file("d.results.h5"), results, asleep}, {});
    EXPECT_FALSE(last.report.automatic[0].was_awake);
  }
}

/// A stout rod that two joints hold, neither of which stresses it alone, with a force across its middle by which it
/// bends at rest, as seen from its ends, 3 F L³/(48 EI), by 0.3 of the tolerance 0.01; a tenth of it swings at `part`
/// of its first frequency.
formats::Scene shaken(double part) {
  formats::Scene scene = automatic(test_support::empty_scene(2.5e-4, 1.0));
  scene.automatic.tolerance = 0.01;
  scene.bodies.push_back(test_support::modal_spec("rod", "stout"));
  scene.joints = {test_support::joint("a", JointKind::spherical, "ground", "rod/n0", Vector3d::Zero(), z),
                  test_support::joint("b", JointKind::point_on_line, "ground", "rod/n8", {2, 0, 0}, Vector3d::UnitX())};
  const double EI = 2.1e11 * 1.0e-6, length = 2.0, mass_per_length = 7800.0 * 4.0e-4;
  const double omega = std::pow(M_PI / length, 2) * std::sqrt(EI / mass_per_length);
  const double force = 0.1 * 48.0 * EI / std::pow(length, 3) * length * scene.automatic.tolerance;
  scene.loads = {test_support::constant_load("shake", formats::LoadKind::force, "rod/n4", Vector3d::Zero())};
  scene.loads[0].components[1] = formats::TimeExpression{
      fmt::format("{} * (1 + 0.1 * t^4 / (t^4 + 1e-4) * sin({} * t))", force, part * omega), {}, "here"};
  return scene;
}

// Slow, it bends as at rest, and its inertia changes that tenth by 0.0025; near its frequency it bends ten times as
// much, which only that inertia knows.
TEST(AutomaticModalBodies, WakeInResonance) {
  TemporaryFolder folder;
  EXPECT_EQ(run(shaken(0.05), folder.file("a.results.h5")).report.automatic[0].part_on, 0.0);
  EXPECT_GT(run(shaken(0.98), folder.file("b.results.h5")).report.automatic[0].part_on, 0.5);
}

// Nothing holds it, and nothing but its spin bends it: there are no reactions to be asked for.
TEST(AutomaticModalBodies, FlyWithoutJoints) {
  TemporaryFolder folder;
  formats::Scene scene = automatic(test_support::empty_scene(1e-3, 0.3));
  formats::ModalBodySpec rod = test_support::modal_spec("rod", "clamped");
  rod.start.velocity = Vector3d(300, 0, 0);
  rod.start.angular_velocity = Vector3d(0, 0, 1);
  scene.bodies = {rod};
  const RunReport report = run(scene, folder.file("a.results.h5")).report;
  EXPECT_EQ(report.outcome, RunOutcome::completed) << report.reason;
  EXPECT_EQ(report.automatic[0].part_on, 0.0);
}

// A stout cantilever that a pulse of 100 bends wakes, and sleeps when that is over: what then shakes it on and on, by 2
// or 5 at a hundredth of its first frequency, is as small to the body that is awake as to the one that sleeps. (It once
// woke and slept 88 times in three seconds.)
TEST(AutomaticModalBodies, DoNotChatter) {
  for (const char* file : {"stout", "stout mean", "stout clamped"})
    for (const double force : {2.0, 5.0}) {
      SCOPED_TRACE(fmt::format("{}, {}", file, force));
      TemporaryFolder folder;
      const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
      formats::Scene scene = test_support::empty_scene(2.5e-4, 1.6);
      formats::ModalBodySpec rod = test_support::modal_spec("rod", file);
      rod.damping.ratio = 0.2;
      scene.bodies.push_back(rod);
      scene.joints = {test_support::joint("clamp", JointKind::fixed, "ground", "rod/n0", Vector3d::Zero(), z)};
      scene.loads = {test_support::constant_load("pulse", formats::LoadKind::force, "rod/n8", Vector3d::Zero()),
                     test_support::constant_load("shake", formats::LoadKind::force, "rod/n8", Vector3d::Zero())};
      scene.loads[0].components[2] =
          formats::TimeTable{{0.0, 0.1, 0.3, 0.5, 0.8, 9.0}, {0.0, 0.0, 100.0, 100.0, 0.0, 0.0}};
      scene.loads[1].components[1] = formats::TimeExpression{fmt::format("{} * sin(62.8 * t)", force), {}, "here"};
      const RunReport report = run(automatic(scene), a).report;
      run(scene, b);
      EXPECT_LE(report.automatic[0].changes.size(), 4U);
      EXPECT_LT(largest_difference(a, b, {"joints/force"}), 0.02 * largest_value(b, {"joints/force"}));
    }
}

// What falls asleep shakes what is welded to it, which no criterion of it alone sees.
TEST(AutomaticModalBodies, PiecesOfAWeldThatSleepAreDoubted) {
  TemporaryFolder folder;
  formats::Scene scene = automatic(test_support::empty_scene(1e-3, 1.0));
  scene.automatic.tolerance = 0.03;
  for (const char* name : {"stout", "hinged"}) {
    formats::ModalBodySpec piece = test_support::modal_spec(name, name);
    piece.damping.ratio = 0.1;
    piece.start.pose.position = {scene.bodies.empty() ? 0.0 : 2.0, 0, 0};
    scene.bodies.push_back(piece);
  }
  scene.joints = {test_support::joint("clamp", JointKind::fixed, "ground", "stout/n0", Vector3d::Zero(), z),
                  test_support::joint("weld", JointKind::fixed, "stout/n8", "hinged/n0", {2, 0, 0}, z)};
  scene.loads = {test_support::constant_load("pulse", formats::LoadKind::force, "hinged/n8", Vector3d::Zero())};
  scene.loads[0].components[1] = formats::TimeTable{{0.0, 0.1, 0.2, 0.3, 0.4, 9.0}, {0.0, 0.0, 30.0, 30.0, 0.0, 0.0}};
  const RunReport report = run(scene, folder.file("a.results.h5")).report;
  EXPECT_THAT(fmt::format("{}", fmt::join(report.doubts, " ")),
              ::testing::HasSubstr("stout fell asleep welded to flexible bodies"));
}

}  // namespace
}  // namespace tisserand::mechanism::automatic_modal_test

// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that choose the flexibility of modal bodies by themselves, in each frame that modes can have.
#include <cmath>
#include <optional>

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

/// Modal bodies of a slender rod (ten modes) and of a stout one (eleven). Modes are hinged at the ends, of the mean
/// axis, or clamped at the first node.
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

TEST(AutomaticModalBodies, ThatDoNotMatterAreRigid) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
  const RunReport report = run(automatic(pendulum()), a).report;
  run(rigid(pendulum()), b);
  ASSERT_EQ(report.automatic.size(), 1U);
  EXPECT_FALSE(report.automatic[0].on);
  EXPECT_LT(report.automatic[0].demand, 1.0);
  EXPECT_GT(largest_value(b, {"joints/rate"}), 1.0);
  EXPECT_EQ(largest_difference(a, b, {"nodes", "joints", "energy"}), 0.0);
}

// A moment bends the rod from 0.1 to 0.4 s, for each frame of its modes. A rigid rod has errors of force above the
// tolerance. From a checkpoint or a stored instant the run makes the choice of the run that wrote it.
TEST(AutomaticModalBodies, ThatMatterAreOn) {
  for (const char* file : {"hinged", "mean", "clamped"}) {
    SCOPED_TRACE(file);
    TemporaryFolder folder;
    const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5"), c = folder.file("c.results.h5");
    formats::Scene always = swing(file);
    always.checkpoint.interval = 0.5;  // at which a run forgets its factors
    const formats::Scene scene = automatic(always);
    const RunEnd own = run(scene, a);
    run(always, b);
    run(rigid(swing(file)), c);
    ASSERT_EQ(own.report.outcome, RunOutcome::completed) << own.report.reason;
    EXPECT_THAT(own.report.doubts, ::testing::IsEmpty());
    EXPECT_TRUE(own.report.automatic[0].on);
    EXPECT_GT(own.report.automatic[0].time, 0.1);
    EXPECT_LT(own.report.automatic[0].time, 0.2);
    EXPECT_EQ(largest_difference(a, b, {"nodes", "modal_bodies", "joints", "energy"}), 0.0);
    EXPECT_GT(largest_difference(c, b, {"joints/force"}), 0.02 * largest_value(b, {"joints/force"}));
    const BodyFiles list = files();
    for (const std::string& from : {folder.file("a.checkpoint.h5"), a}) {
      const std::optional<double> at = from == a ? std::optional(0.5) : std::nullopt;
      const RunEnd rest = simulate(RunRequest{scene, list, std::nullopt, folder.file("d.results.h5"), from, at}, {});
      EXPECT_TRUE(rest.report.automatic[0].on);
      if (at) {
        EXPECT_LT((rest.state.x() - own.state.x()).norm(), 1e-3 * own.state.x().norm());
      } else {
        EXPECT_EQ(rest.state.block(), own.state.block());
      }
    }
  }
}

/// Scene of a stout rod between two joints, neither of which stresses it alone. A force across its middle bends it at
/// rest, as seen from its ends, 3 F L³/(48 EI), by 0.3 of the tolerance 0.01. A tenth of the force swings at `part` of
/// the rod's first frequency.
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

// At a low frequency the rod bends as at rest, and its inertia changes that tenth by 0.0025. Near its first frequency
// it bends ten times as much, which depends on its inertia.
TEST(AutomaticModalBodies, AreOnInResonance) {
  TemporaryFolder folder;
  EXPECT_FALSE(run(shaken(0.05), folder.file("a.results.h5")).report.automatic[0].on);
  EXPECT_TRUE(run(shaken(0.98), folder.file("b.results.h5")).report.automatic[0].on);
}

// No joint holds the rod and only its spin bends it: no reactions exist from which to estimate the effect.
TEST(AutomaticModalBodies, FlyWithoutJoints) {
  TemporaryFolder folder;
  formats::Scene scene = automatic(test_support::empty_scene(1e-3, 0.3));
  formats::ModalBodySpec rod = test_support::modal_spec("rod", "clamped");
  rod.start.velocity = Vector3d(300, 0, 0);
  rod.start.angular_velocity = Vector3d(0, 0, 1);
  scene.bodies = {rod};
  const RunReport report = run(scene, folder.file("a.results.h5")).report;
  EXPECT_EQ(report.outcome, RunOutcome::completed) << report.reason;
  EXPECT_FALSE(report.automatic[0].on);
}

}  // namespace
}  // namespace tisserand::mechanism::automatic_modal_test

// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that choose effects by themselves: the run is that of the scene with its choice, to the bit; what is off errs by
// less than the tolerance, and what matters is on.
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/results/results.hpp"
#include "mechanism/bdf/bdf.hpp"
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
  stout.length = 0.2;
  test_support::add_file("stump", test_support::craig_bampton_beam(stout, 3), list.superelements);
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

const std::vector<std::string> everything = {"nodes", "joints", "energy"};

/// What the run chose of its only automatic effect.
ChosenEffect choice(const RunReport& report) {
  EXPECT_EQ(report.automatic.size(), 1U);
  return report.automatic.empty() ? ChosenEffect{} : report.automatic[0];
}

TEST(AutomaticEffects, ThatDoNotMatterAreOff) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
  const RunReport report = run(with(pendulum(), {automatic(Effect::flexibility)}), a);
  run(with(pendulum(), {fixed(Effect::flexibility, false)}), b);
  EXPECT_FALSE(choice(report).on);
  EXPECT_GT(choice(report).demand, 0.0);
  EXPECT_LT(choice(report).demand, 1.0);
  EXPECT_EQ(report.repeated, 0);
  EXPECT_GT(largest_value(b, {"joints/rate"}), 1.0);
  EXPECT_EQ(largest_difference(a, b, everything), 0.0);
}

// A moment that bends it from 0.1 to 0.4: the run begins again, once, with flexibility. The rigid scene errs by more
// than the tolerance in its forces.
TEST(AutomaticEffects, ThatMatterAreOn) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5"), c = folder.file("c.results.h5");
  const RunReport report = run(with(swing(300.0), {automatic(Effect::flexibility)}), a);
  run(swing(300.0), b);
  run(with(swing(300.0), {fixed(Effect::flexibility, false)}), c);
  EXPECT_TRUE(choice(report).on);
  EXPECT_GT(choice(report).demand, 1.0);
  EXPECT_GT(choice(report).time, 0.1);
  EXPECT_LT(choice(report).time, 0.2);
  EXPECT_GT(report.repeated, 90);
  EXPECT_LT(report.repeated, 210);
  EXPECT_EQ(largest_difference(a, b, everything), 0.0);
  EXPECT_EQ(largest_difference(a, b, {"superelements"}), 0.0);
  EXPECT_GT(largest_difference(c, b, {"joints/force"}), 0.02 * largest_value(b, {"joints/force"}));
}

// By every method; with steps under control too. Those of bdf and radau differ in the last digits.
TEST(AutomaticEffects, AreChosenByEveryMethod) {
  for (const formats::Method method :
       {formats::Method::hht, formats::Method::radau, formats::Method::bdf, formats::Method::generalised_alpha}) {
    if (method == formats::Method::bdf && !bdf_available()) continue;
    SCOPED_TRACE(static_cast<int>(method));
    formats::Scene stout = pendulum(), bent = swing(300.0);
    for (formats::Scene* scene : {&stout, &bent}) {
      scene->integrator.method = method;
      scene->integrator.error_control.active = method != formats::Method::hht;
      scene->effects = {automatic(Effect::flexibility)};
    }
    EXPECT_FALSE(choice(run(stout, "")).on);
    EXPECT_TRUE(choice(run(bent, "")).on);
  }
}

// A rigid piece would hold the one that it is welded to.
TEST(AutomaticEffects, AreThoseOfAllPiecesOfAWeld) {
  formats::Scene two = swing(300.0);
  formats::SuperelementBodySpec second = test_support::superelement_body("second", "stump");
  second.start.pose.position = {2, 0, 0};
  two.bodies.emplace_back(second);
  two.joints.push_back(test_support::joint("weld", JointKind::fixed, "beam/tip", "second/base", {2, 0, 0}, z));
  const RunReport welded = run(with(two, {automatic(Effect::flexibility)}), "");
  ASSERT_EQ(welded.automatic.size(), 2U);
  EXPECT_LT(welded.automatic[1].demand, 0.5);
  EXPECT_TRUE(welded.automatic[0].on && welded.automatic[1].on);
  two.joints.back().kind = JointKind::spherical;
  const RunReport jointed = run(with(two, {automatic(Effect::flexibility)}), "");
  EXPECT_TRUE(jointed.automatic[0].on && !jointed.automatic[1].on);
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

// To the bit, from a checkpoint and with the choice of the run that wrote it; a run that is off where it matters says
// so, since it cannot begin again.
TEST(AutomaticEffects, GoOnFromACheckpointWithItsChoice) {
  const BodyFiles list = files();
  for (const bool matters : {true, false}) {
    TemporaryFolder folder;
    formats::Scene scene = with(matters ? swing(300.0) : pendulum(), {automatic(Effect::flexibility)});
    scene.checkpoint.interval = 0.3;
    const std::string kept = folder.file("kept.h5"), results = folder.file("a.results.h5");
    RunControl control;
    control.progress = [&](double time) {
      const std::string written = folder.file("a.checkpoint.h5");
      if (time > 0.3 && std::filesystem::exists(written) && !std::filesystem::exists(kept))
        std::filesystem::copy_file(written, kept);
    };
    const RunEnd whole = simulate(RunRequest{scene, list, std::nullopt, results, "", std::nullopt}, control);
    for (const std::string& from : {kept, results}) {
      const std::optional<double> at = from == results ? std::optional(0.3) : std::nullopt;
      const RunEnd rest = simulate(RunRequest{scene, list, std::nullopt, folder.file("b.results.h5"), from, at}, {});
      EXPECT_EQ(choice(rest.report).on, matters);
      EXPECT_LT(rest.report.steps, whole.report.steps);
      if (at) {
        EXPECT_LT((rest.state.x() - whole.state.x()).norm(), 1e-3 * whole.state.x().norm());
      } else {
        EXPECT_EQ(rest.state.block(), whole.state.block());
      }
      EXPECT_THAT(rest.report.doubts, ::testing::IsEmpty());
    }
    if (matters) continue;
    formats::Scene pulled = scene;
    pulled.springs = swing(300.0).springs;
    pulled.springs[0].force = 3e5;
    RunRequest changed{pulled, list, std::nullopt, folder.file("b.results.h5"), kept, std::nullopt};
    changed.changed = ChangedValues::accepted;
    EXPECT_THAT(simulate(changed, {}).report.doubts,
                ::testing::Contains(::testing::AllOf(HasSubstr("flexibility of 'beam' matters at t = 0.3"),
                                                     HasSubstr("run the scene from its start"))));
  }
}

// Nothing of a run that begins again stays: no row, no checkpoint, no older file that it did not write.
TEST(AutomaticEffects, ThatBeginAgainLeaveNothingBehind) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
  formats::Scene scene = with(swing(300.0), {automatic(Effect::flexibility)});
  scene.checkpoint.interval = 0.05;  // before it matters
  RunControl control;
  bool again = false, left = false;
  double latest = 0.0;
  control.progress = [&](double time) {
    if (time < latest) {
      again = true;
      left = left || std::filesystem::exists(folder.file("a.checkpoint.h5"));
    }
    latest = time;
  };
  const BodyFiles list = files();
  simulate(RunRequest{scene, list, std::nullopt, a, "", std::nullopt}, control);
  EXPECT_TRUE(again);
  EXPECT_FALSE(left);
  run(swing(300.0), b);
  EXPECT_EQ(formats::ResultsReader(a).time(), formats::ResultsReader(b).time());
  EXPECT_FALSE(std::filesystem::exists(a + ".part"));
}

/// A slender beam of second order that its hinge spins up: stiffening holds it straight, without it bends away.
formats::Scene spin_up() {
  formats::Scene scene = test_support::empty_scene(2e-3, 2.0);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  scene.joints = {test_support::joint("hinge", JointKind::revolute, "ground", "beam/n0", Vector3d::Zero(), z)};
  scene.motions = {test_support::drive("hinge", "t < 1 ? 2 * t^2 : 4 * t - 2", {1.0})};
  return scene;
}

TEST(AutomaticEffects, StiffeningIsOnWhereABeamSpins) {
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(1e4), 1.0, 4);
  const BodyFiles list = test_support::files_of(test_support::second_order_beam(beam, {0, 4}, 2));
  const auto end_of = [&](const std::string& speed, const std::vector<formats::EffectSwitch>& effects) {
    formats::Scene scene = with(spin_up(), effects);
    scene.motions = {test_support::drive("hinge", speed)};
    return simulate(RunRequest{scene, list, std::nullopt, "", "", std::nullopt}, {});
  };
  const std::string fast = "2 * t^2", slow = "1e-3 * t^2";
  const RunEnd whole = end_of(fast, {}), own = end_of(fast, {automatic(Effect::stiffening)});
  EXPECT_TRUE(choice(own.report).on);
  EXPECT_EQ(own.state.block(), whole.state.block());
  EXPECT_FALSE(choice(end_of(slow, {automatic(Effect::stiffening)}).report).on);
}

// While forces grow from nothing, what its inertia does to them is a large part of what they are and a small one of
// what they become: of a force that goes with t², 2/(ω t)².
TEST(AutomaticEffects, AreOffWhereForcesGrowFromNothing) {
  TemporaryFolder folder;
  const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
  formats::Scene scene = pendulum();
  scene.gravity.setZero();
  scene.integrator.end = 0.8;
  scene.motions = {test_support::drive("hinge", "2 * t^4")};
  const RunReport report = run(with(scene, {automatic(Effect::flexibility)}), a);
  run(scene, b);
  EXPECT_FALSE(choice(report).on);
  EXPECT_GT(largest_value(b, {"joints/force"}), 10.0);
  EXPECT_LT(largest_difference(a, b, {"joints/force"}), 1e-3 * largest_value(b, {"joints/force"}));
}

// 0.4 (1 + 4 t) of the tolerance is reached at t = 0.375, seen at the next sample, every four steps.
TEST(AutomaticEffects, SayWhenTheyMatter) {
  const ChosenEffect chosen = choice(run(with(GrowingLoad().scene, {automatic(Effect::flexibility)}), ""));
  EXPECT_TRUE(chosen.on);
  EXPECT_NEAR(chosen.demand, 1.0, 0.02);
  EXPECT_NEAR(chosen.time, 0.375, 0.01);
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
// five times more than what shakes it, which builds up to several tolerances.
TEST(AutomaticEffects, AreOnAtAResonanceThatTheWeightHides) {
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
  EXPECT_TRUE(choice(report).on);
  EXPECT_GT(choice(report).time, 0.1);  // not at once
  const double tolerance = 0.01 * 2.0;
  EXPECT_EQ(largest_difference(a, b, {"nodes/position/beam/tip/*"}), 0.0);
  EXPECT_GT(largest_difference(c, b, {"nodes/position/beam/tip/*"}), 3.0 * tolerance);
}

// Straight under its axial load it bends by nothing, and buckles. A tenth of the load of Euler, π² EI/l² with the
// weaker EI of 100, is reached at t = 0.1.
TEST(AutomaticEffects, AreOnWhereAColumnBuckles) {
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(1e5), 2.0, 8);
  const BodyFiles list = test_support::files_of(test_support::second_order_beam(beam, {0, 4, 8}, 6));
  formats::Scene scene = test_support::empty_scene(1e-3, 0.3);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  scene.bodies.emplace_back(test_support::rigid_body("block", 1.0, Vector3d::Zero(), {1, 1, 1}));
  scene.joints = {test_support::joint("clamp", JointKind::fixed, "ground", "beam/n0", Vector3d::Zero(), z),
                  test_support::joint("hold", JointKind::fixed, "ground", "block", Vector3d::Zero(), z)};
  scene.loads = {test_support::constant_load("axial", formats::LoadKind::force, "beam/n8", Vector3d::Zero()),
                 test_support::constant_load("other", formats::LoadKind::force, "block", {0, 1000, 0})};
  const double euler = std::numbers::pi * std::numbers::pi * 100.0 / 4.0;
  scene.loads[0].components[0] = formats::TimeTable{{0.0, 0.2, 1.0}, {0.0, -0.2 * euler, -0.2 * euler}};
  scene.effects = {automatic(Effect::flexibility), automatic(Effect::stiffening)};
  const RunReport report = simulate(RunRequest{scene, list, std::nullopt, "", "", std::nullopt}, {}).report;
  ASSERT_EQ(report.automatic.size(), 2U);
  for (const ChosenEffect& chosen : report.automatic) EXPECT_TRUE(chosen.on) << chosen.effect;
  EXPECT_NEAR(report.automatic[0].time, 0.1, 0.005);  // a sample every four steps
}

// Its internal coordinates rest at the equilibrium of a load on its tip, but the beam is bent: it stays so. Bent by
// less than the tolerance it begins straight, on its clamp.
TEST(AutomaticEffects, KeepTheDeformationThatStaticsFound) {
  const BodyFiles list = files();
  formats::Scene scene = test_support::empty_scene(1e-3, 0.1);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  scene.joints = {test_support::joint("clamp", JointKind::fixed, "ground", "beam/base", Vector3d::Zero(), z)};
  scene.loads = {test_support::constant_load("tip", formats::LoadKind::force, "beam/tip", {0, 100, 0})};
  formats::Scene at_rest = scene;
  at_rest.analysis = formats::AnalysisKind::statics;
  const RunEnd bent = simulate(RunRequest{at_rest, list, std::nullopt, "", "", std::nullopt}, {});
  const formats::Scene chosen = with(scene, {automatic(Effect::flexibility)});
  const RunEnd own = simulate(RunRequest{chosen, list, bent.state, "", "", std::nullopt}, {});
  const double deflection = 100.0 * 8.0 / (3.0 * 2.1e11 * 2.0e-8);  // P l³/(3 EI)
  EXPECT_GT(bent.state.x().row(1).maxCoeff(), 0.9 * deflection);
  EXPECT_TRUE(choice(own.report).on);
  EXPECT_EQ(own.report.repeated, 0);
  EXPECT_LT((own.state.x() - bent.state.x()).cwiseAbs().maxCoeff(), 1e-6 * deflection);
  formats::Scene tolerant = chosen;
  tolerant.automatic.tolerance = 1.1 * deflection / 2.0;  // of the size
  const RunEnd straight = simulate(RunRequest{tolerant, list, bent.state, "", "", std::nullopt}, {});
  EXPECT_FALSE(choice(straight.report).on);
  EXPECT_LT((straight.state.x() - bent.state.x()).cwiseAbs().maxCoeff(), 1.001 * deflection);
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
TEST(AutomaticEffects, AreOnWhereReactionsStressABody) {
  const auto reported = ::testing::Contains(HasSubstr("effects of beam are on"));
  for (const double angle : {0.0, 1e-12, 1e-6, 0.1}) {
    SCOPED_TRACE(angle);
    TemporaryFolder folder;
    const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
    const RunReport report = run(on_two_hinges(angle), a);
    run(with(on_two_hinges(angle), {}), b);
    EXPECT_THAT(report.notes, reported);
    EXPECT_TRUE(choice(report).on);
    EXPECT_EQ(report.repeated, 0);
    EXPECT_EQ(largest_difference(a, b, {"nodes", "joints", "superelements"}), 0.0);
  }
}

/// A four-bar of two kinds of beams of 2 m, closed in the plane, with a drive at A and random joints at B, C and D. It
/// begins at rest without loads: what `on` would add there no choice knows.
formats::Scene random_loop(std::mt19937& random) {
  const auto between = [&random](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  const double length = 2.0, ground = between(1.0, 3.0), angle = between(0.8, 2.2);
  const Vector3d D(ground, 0, 0), P = length * Vector3d(std::cos(angle), std::sin(angle), 0.0);
  const Vector3d apart = D - P, middle = 0.5 * (P + D);
  const Vector3d up = std::sqrt(length * length - 0.25 * apart.squaredNorm()) * z.cross(apart.normalized());
  const Vector3d C = middle + up;
  formats::Scene scene = test_support::empty_scene(1e-3, 0.6);
  const auto add = [&](const std::string& name, const Vector3d& from, const Vector3d& to) {
    formats::SuperelementBodySpec bar = test_support::superelement_body(name, between(0, 1) < 0.5 ? "beam" : "stout");
    bar.damping.ratio = 0.1;
    bar.start.pose.position = from;
    bar.start.pose.orientation = Eigen::AngleAxisd(std::atan2(to.y() - from.y(), to.x() - from.x()), z);
    scene.bodies.emplace_back(bar);
  };
  add("left", Vector3d::Zero(), P);
  add("top", P, C);
  add("right", C, D);
  constexpr std::array kinds{JointKind::revolute, JointKind::spherical, JointKind::spherical, JointKind::cylindrical};
  const auto kind = [&] { return kinds[std::uniform_int_distribution<std::size_t>(0, kinds.size() - 1)(random)]; };
  scene.joints = {test_support::joint("A", JointKind::revolute, "ground", "left/base", Vector3d::Zero(), z),
                  test_support::joint("B", kind(), "left/tip", "top/base", P, z),
                  test_support::joint("C", kind(), "top/tip", "right/base", C, z),
                  test_support::joint("D", kind(), "ground", "right/tip", D, z)};
  scene.motions = {test_support::drive(
      "A", fmt::format("{} * sin({} * t) * t^3 / (t^3 + 0.01)", between(0.05, 0.3), between(1.0, 8.0)))};
  return scene;
}

// Forces too: with the choice of the run they differ from those with everything on by the tolerance at most.
TEST(AutomaticEffects, KeepForcesOfRandomLoops) {
  constexpr double tolerance = 3e-3;
  std::mt19937 random(45);
  int off = 0, on = 0;
  for (int loop = 0; loop < 20; ++loop) {
    SCOPED_TRACE(loop);
    TemporaryFolder folder;
    const std::string a = folder.file("a.results.h5"), b = folder.file("b.results.h5");
    const formats::Scene scene = random_loop(random);
    formats::Scene own = with(scene, {automatic(Effect::flexibility)});
    own.automatic.tolerance = tolerance;
    const RunReport report = run(own, a);
    ASSERT_EQ(report.outcome, RunOutcome::completed) << report.reason;
    run(scene, b);
    for (const ChosenEffect& chosen : report.automatic) ++(chosen.on ? on : off);
    EXPECT_LT(largest_difference(a, b, {"joints/force"}), tolerance * largest_value(b, {"joints/force"}));
    EXPECT_LT(largest_difference(a, b, {"nodes/position/*/base/*", "nodes/position/*/tip/*"}), tolerance * 2.0);
  }
  EXPECT_GT(off, 5);
  EXPECT_GT(on, 5);
}

TEST(AutomaticEffects, SayNothingOfReactionsThatStressNoBody) {
  EXPECT_THAT(run(with(pendulum(), {automatic(Effect::flexibility)}), "").notes,
              ::testing::Not(::testing::Contains(HasSubstr("are on"))));
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
}

}  // namespace
}  // namespace tisserand::mechanism::automatic_effects_test

// SPDX-License-Identifier: GPL-3.0-or-later
// What crossings found, each in the smallest scene that shows it.
#include <string>

#include <gtest/gtest.h>

#include "mechanism/bdf/bdf.hpp"
#include "tests/support/crossings/changes.hpp"
#include "tests/support/crossings/history.hpp"
#include "tests/support/crossings/ingredients.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support::crossings::found_test {
namespace {

History run(const formats::Scene& scene) {
  const Similarity same;
  return run_history(scene, scene, same, arm_files());
}
History run(const formats::Scene& scene, Change change) {
  const Similarity s = similarity_of(change);
  return run_history(changed(scene, change), scene, s, arm_files());
}

// A flexible body and the bob fall freely: the hinge between them, which has friction, carries nothing but round-off.
TEST(CrossingFound, FrictionWhereNothingPresses) {
  for (const Scheme scheme : {Scheme::index_2, Scheme::index_3, Scheme::radau, Scheme::bdf}) {
    if (scheme == Scheme::bdf && !mechanism::bdf_available()) continue;
    for (const Arm arm : {Arm::beam_2, Arm::karcher_B, Arm::modal}) {
      const History fall = run(dynamics_scene({arm, Hinge::constant_orientation, Action::friction, scheme}));
      EXPECT_EQ(fall.refusal, "") << name_of(arm) << ' ' << name_of(scheme);
      EXPECT_EQ(fall.report.outcome, mechanism::RunOutcome::completed) << fall.report.reason;
    }
  }
}

// Velocities that no joint and no drive determine: those of the least kinetic energy, to round-off and not to 1e-7.
TEST(CrossingFound, FreeVelocitiesAtTheStartAreExact) {
  for (const Arm arm : {Arm::rigid, Arm::karcher_B, Arm::beam_3})
    for (const Hinge hinge : {Hinge::revolute, Hinge::universal, Hinge::planar}) {
      formats::Scene scene = dynamics_scene({arm, hinge, Action::drive, Scheme::index_2});
      scene.integrator.end = scene.integrator.step;
      const History before = run(scene).every(10), after = run(scene, Change::turned).every(10);
      EXPECT_LT(compare_histories(before, after, {Family::rate}).largest, 1e-12)
          << name_of(arm) << ' ' << name_of(hinge);
    }
}

// Milliseconds and seconds: tolerances of velocities are per second, so that CVODE takes the same steps.
TEST(CrossingFound, StepsOfBdfDoNotDependOnTheUnitOfTime) {
  if (!mechanism::bdf_available()) GTEST_SKIP() << "this build has no CVODE";
  const formats::Scene scene = dynamics_scene({Arm::beam_3, Hinge::generic, Action::line_spring, Scheme::bdf});
  const History before = run(scene), after = run(scene, Change::units);
  EXPECT_NEAR(static_cast<double>(after.report.steps), static_cast<double>(before.report.steps),
              0.1 * static_cast<double>(before.report.steps));
}

// At 1 km positions are rounded to 1e-13 m: where no iteration gets any further, a step is done.
TEST(CrossingFound, StepsFarFromTheOriginEndAtRoundOff) {
  const formats::Scene scene =
      dynamics_scene({Arm::second_order, Hinge::cylindrical, Action::nothing, Scheme::index_3});
  const History far = run(scene, Change::far);
  EXPECT_EQ(far.report.outcome, mechanism::RunOutcome::completed) << far.report.reason;
  EXPECT_EQ(far.report.rejected, 0);
}

// Kinematics there halved its steps, and work and dissipation changed by 1e-5.
TEST(CrossingFound, KinematicsFarFromTheOriginTakesTheStepsThatItIsGiven) {
  formats::Scene scene = dynamics_scene({Arm::rigid, Hinge::revolute, Action::drive, Scheme::index_2});
  scene.motions.push_back(drive("wrist", "0.3*t"));
  scene.analysis = formats::AnalysisKind::inverse_dynamics;
  scene.integrator.end = 1.0;
  const History near = run(scene), far = run(scene, Change::far);
  EXPECT_EQ(far.refusal, "");
  EXPECT_EQ(far.report.rejected, 0);
  EXPECT_EQ(disagreement(near, far, {}), "");
}

}  // namespace
}  // namespace tisserand::test_support::crossings::found_test

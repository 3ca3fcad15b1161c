// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes on which a former version was wrong or silent, against closed forms (tests/verification/references/trials).
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "tests/support/scenes/trial.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::mechanism::trials_test {
namespace {

using std::numbers::pi;
using test_support::Trial;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Reduces <part>.part.yaml into the folder; the path of its superelement.
std::string reduce(const std::string& part, const test_support::TemporaryFolder& folder,
                   const std::string& settings = "") {
  const std::string path = folder.file(part + ".superelement.h5");
  const std::string command = TISSERAND_BINARY_DIR "/bin/reducer run " TISSERAND_SOURCE_DIR
                                                   "/tests/verification/references/trials/" +
                              part + ".part.yaml " + settings + " -o " + path + " > " + folder.file("log") + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return path;
}

bool has_reducer() { return std::filesystem::exists(TISSERAND_BINARY_DIR "/bin/reducer"); }

// A physical pendulum hangs below its hinge. It starts `angle` degrees off; the joint coordinate counts from there.
TEST(HangingStatics, PendulumFromAnyStart) {
  for (const double angle : {1.0, 30.0, 89.0, 90.0, 120.0, 170.0}) {
    const Trial trial("fail2_hanging_statics", {fmt::format("bodies.arm.pose.orientation.angle_deg={}", angle)});
    EXPECT_EQ(trial.report().outcome, RunOutcome::completed);
    EXPECT_NEAR(trial.last("joints/coordinate/hinge"), -angle * pi / 180.0, 1e-8) << angle;
  }
}

// A uniform bar of 1 m that hangs on a hinge, a superelement with internal modes: f = sqrt(3 g/2L)/2π = 0.61051 Hz,
// from any start and with any frame.
TEST(HangingStatics, SuperelementOnAHinge) {
  if (!has_reducer()) GTEST_SKIP() << "built without the reducer, which makes the superelements";
  const test_support::TemporaryFolder folder;
  const std::string file = "bodies.s.file=" + reduce("bar", folder);
  for (const char* setting : {"bodies.s.second_order=on", "bodies.s.second_order=off", "bodies.s.frame={node: base}",
                              "bodies.s.pose={orientation: {axis: [0, 1, 0], angle_deg: 60}}",
                              "bodies.s.pose={orientation: {axis: [0, 1, 0], angle_deg: -100}}"}) {
    const Trial trial("hanging_superelement", {file, setting});
    EXPECT_EQ(trial.report("rest").outcome, RunOutcome::completed) << setting;
    EXPECT_NEAR(trial.frequencies("tones").front(), 0.61051, 1e-4) << setting;
  }
}

// In its plane the same pendulum falls from 170 degrees.
TEST(HangingStatics, PlanarPendulum) {
  const Trial trial("fail2_hanging_statics", {"effects={planar: on}", "bodies.arm.pose.orientation.angle_deg=170"});
  EXPECT_EQ(trial.report().outcome, RunOutcome::completed);
  EXPECT_NEAR(std::abs(trial.last("joints/coordinate/hinge")), 170.0 * pi / 180.0, 1e-8);
}

// The bar of SuperelementOnAHinge as a modal body: masses lumped at the nodes of ten elements have 1 + 1/200 of its
// inertia about the hinge.
TEST(HangingStatics, ModalBodyOnAHinge) {
  if (!has_reducer()) GTEST_SKIP() << "built without the reducer, which makes the modal body";
  const test_support::TemporaryFolder folder;
  reduce("bar", folder);
  for (const double angle : {0.0, 60.0, -80.0, -100.0}) {
    const Trial trial("hanging_modal",
                      {"bodies.m.file=" + folder.file("bar.modal.h5"), fmt::format("parameters.angle={}", angle)});
    EXPECT_EQ(trial.report("rest").outcome, RunOutcome::completed) << angle;
    EXPECT_NEAR(trial.last("nodes/position/m/tip/z", "rest"), -1.0, 1e-5) << angle;
    EXPECT_NEAR(trial.frequencies("tones").front(), 0.61051 / std::sqrt(1.005), 5e-5) << angle;
  }
}

// A hook of 10 kg on two cables that are shorter than their distance: 2 k (l - l0) v/l = m g with l = sqrt(0.9^2 +
// v^2), v the depth of its eyes. Its centre of mass hangs below the middle.
TEST(HangingStatics, HookOnTwoCables) {
  double low = 0.0, high = 2.0;
  for (int i = 0; i < 60; ++i) {
    const double v = 0.5 * (low + high), l = std::hypot(0.9, v);
    (2.0 * 2000.0 * (l - 1.1) * v / l < 98.1 ? low : high) = v;
  }
  const Trial trial("hook_on_cables");
  EXPECT_EQ(trial.report().outcome, RunOutcome::completed);
  EXPECT_NEAR(trial.last("nodes/position/hook/z"), -low, 1e-8);
  EXPECT_NEAR(trial.last("nodes/position/hook/x"), 0.0, 1e-8);
  EXPECT_NEAR(trial.last("nodes/position/hook/y"), 0.0, 1e-8);
}

// Weight 294.3 N on three springs of 4000 N/m: each lengthens by 0.024525 m.
TEST(HangingStatics, PlateOnThreeRopes) {
  const Trial trial("fail2b_plate_on_ropes");
  EXPECT_EQ(trial.report().outcome, RunOutcome::completed);
  EXPECT_NEAR(trial.last("nodes/position/plate/z"), -2.024525, 1e-6);
}

// m g = k (x - 0.01 m): the body falls freely onto its stop.
TEST(HangingStatics, BodyFallsOntoAStop) {
  EXPECT_NEAR(Trial("stop_statics").last("nodes/position/b/z"), -0.011962, 1e-6);
}

// Without gravity nothing holds the pendulum, and the message names its hinge.
TEST(HangingStatics, WhatNothingHoldsIsAnError) {
  EXPECT_THAT(test_support::error_of([] { Trial("fail2_hanging_statics", {"gravity=[0, 0, 0]"}); }),
              HasSubstr("nothing holds coordinate 'hinge'"));
}

// From 60 degrees Newton's iteration ends upright, at 180 degrees: one unstable direction, as `modes` has it. `stable`
// ends where m g l sin q = -k (q - 60°): 0.005 degrees.
TEST(UnstableStatics, IsAnOutcomeAndCanBeLeft) {
  const Trial upright("fail3_unstable_equilibrium");
  EXPECT_EQ(upright.report("rest").outcome, RunOutcome::unstable);
  EXPECT_THAT(upright.report("rest").reason, HasSubstr("unstable in 1 direction, first coordinate 'hinge'"));
  EXPECT_THAT(upright.report("tones").notes, ::testing::Contains(HasSubstr("1 mode grows")));
  const Trial hanging("fail3_unstable_equilibrium", {"analyses.rest.statics.stable=yes"});
  EXPECT_EQ(hanging.report("rest").outcome, RunOutcome::completed);
  EXPECT_NEAR(hanging.last("joints/coordinate/hinge", "rest") + pi / 3.0, 8.9e-5, 2e-6);
  for (const std::string& note : hanging.report("tones").notes) EXPECT_THAT(note, ::testing::Not(HasSubstr("grow")));
}

// Beck's column flutters beyond 20.05 EI/L² and loses no stiffness before: statics cannot see it, and says so at any
// load.
TEST(UnstableStatics, FollowerForceIsNotDecided) {
  for (const double P : {1.0, 19.9, 20.2}) {
    const Trial trial("follower_column", {fmt::format("parameters.P={}", P)});
    EXPECT_EQ(trial.report("rest").outcome, RunOutcome::completed) << P;
    EXPECT_THAT(trial.report("rest").notes,
                ::testing::Contains(::testing::AllOf(HasSubstr("not symmetric"),
                                                     HasSubstr("does not show whether the equilibrium is stable"))))
        << P;
    EXPECT_EQ(::testing::PrintToString(trial.report("tones").notes).find("grow") != std::string::npos, P > 20.05) << P;
  }
}

TEST(UnstableStatics, NegativeSpring) {
  EXPECT_EQ(Trial("negative_spring").report("rest").outcome, RunOutcome::unstable);
}

// Clamped column under P along its axis and 0.01 N across: elastica with shear and axial strain (elliptic integrals,
// README of the trials: EI = 103.0835 N m², Euler load 254.348 N).
TEST(UnstableStatics, ColumnLeavesForTheElastica) {
  struct Case {
    double load, x, z, tolerance;
    int elements;
  };
  for (const Case& c : {Case{258, 0.213371, 0.971390, 1e-3, 8}, Case{300, 0.627349, 0.701562, 1e-4, 8},
                        Case{2000, 0.453514, -0.543989, 1e-4, 16}}) {
    const std::vector<std::string> settings = {fmt::format("loads.p.value.2={}", -c.load),
                                               fmt::format("bodies.rod.elements={}", c.elements)};
    const Trial straight("buckled_column", settings);
    EXPECT_EQ(straight.report("rest").outcome, RunOutcome::unstable);
    EXPECT_THAT(straight.report("rest").reason, HasSubstr("2 directions"));
    std::vector<std::string> stable = settings;
    stable.push_back("analyses.rest.statics.stable=yes");
    const Trial bent("buckled_column", stable);
    EXPECT_EQ(bent.report("rest").outcome, RunOutcome::completed);
    EXPECT_NEAR(bent.last("nodes/position/rod/end/x", "rest"), c.x, c.tolerance) << c.load;
    EXPECT_NEAR(bent.last("nodes/position/rod/end/z", "rest"), c.z, c.tolerance) << c.load;
    EXPECT_THAT(bent.report("tones").notes, IsEmpty()) << c.load;
  }
  const Trial below("buckled_column", {"loads.p.value.2=-200"});
  EXPECT_EQ(below.report("rest").outcome, RunOutcome::completed);
  EXPECT_NEAR(below.last("nodes/position/rod/end/x", "rest"), 1.4967e-4, 1e-7);
}

// With load steps the report says where the stability is lost: at 254.348 of 300 N.
TEST(UnstableStatics, LoadFactorOfTheLossIsReported) {
  const Trial trial("buckled_column", {"analyses.rest.statics.load_steps=20"});
  EXPECT_THAT(trial.report("rest").notes, ::testing::Contains(HasSubstr("between 0.8 and 0.85 of the load")));
}

TEST(SteadyTurn, RefusesWhatDoesNotTurn) {
  EXPECT_THAT(test_support::error_of([] { Trial("turning_statics_guide"); }),
              HasSubstr("'guide, translation along x of A' does not allow the velocities of this rotation"));
  EXPECT_THAT(test_support::error_of([] { Trial("turning_gravity"); }),
              HasSubstr("does not rotate with the scene: its force on"));
  // A spring about the axis of a driven turn: the drive takes its moment, and the turn is steady.
  EXPECT_THAT(test_support::error_of([] { Trial("steady_spring_on_the_drive"); }), "no error");
}

// Bennett's linkage is regular everywhere, with one degree of freedom. The rows chosen at the start become dependent
// at 1.504 s. j1 at 3 s is 1.10440 rad by index 3, Radau of tolerance 1e-9 and bdf; the kinetic energy stays below 5.6
// J.
TEST(RowsOfConstraints, BennettsLinkageWithEveryMethod) {
  const std::vector<std::pair<std::string, double>> runs = {
      {"integrator.step=1e-3", 1e-5},
      {"integrator.step=1.1e-3", 1e-5},
      {"integrator.formulation=index3", 1e-5},
      {"integrator.method=hht", 1e-5},
      {"integrator.error_control={tolerance: 1e-3}", 1e-3},
      {"integrator.error_control={tolerance: 1e-4}", 1e-4},
      {"integrator={method: radau, step: auto, end: 3, error_control: {tolerance: 1e-9}}", 1e-5},
      {"integrator={method: bdf, end: 3}", 1e-4}};
  for (const auto& [setting, tolerance] : runs) {
    const Trial trial("bennett", {setting});
    EXPECT_EQ(trial.report().outcome, RunOutcome::completed) << setting << ": " << trial.report().reason;
    EXPECT_NEAR(trial.last("joints/coordinate/j1"), 1.10440, tolerance) << setting;
    EXPECT_LT(trial.report().largest_balance, 1e-3 * 5.6) << setting;
    EXPECT_THAT(trial.report().doubts, IsEmpty()) << setting;
  }
}

// The balance is 4e-7 J, against 0.02 J that went from weight into friction.
TEST(EnergyReport, ABlockThatSticksIsRight) {
  const Trial trial("fail5_false_energy_doubt");
  EXPECT_THAT(trial.report().doubts, IsEmpty());
  EXPECT_LT(trial.report().largest_balance / trial.report().energy_reference, 1e-4);
}

// A platform at rest with energies of 1e-30 J.
TEST(EnergyReport, RoundOffOfRestIsNoBalance) { EXPECT_THAT(Trial("bushing_tilted").report().doubts, IsEmpty()); }

// The platform starts 8 degrees off level, and the bushing counts from there: a note says so. With orientations of both
// markers 1e5 N m/rad act: 13 963 N m.
TEST(Bushing, OneThatCountsFromATiltedStartIsNoted) {
  const char* note = "bushing 'hydrostatic' (0.14 rad): the bodies have different orientations at the start";
  EXPECT_THAT(Trial("bushing_tilted").report().notes, ::testing::Contains(HasSubstr(note)));
  const Trial level("bushing_tilted",
                    {"bushings.hydrostatic.a={node: ground, orientation: {axis: [1, 0, 0], angle_deg: 0}}",
                     "bushings.hydrostatic.b={node: platform, orientation: {axis: [1, 0, 0], angle_deg: 0}}"});
  EXPECT_THAT(level.report().notes,
              ::testing::Not(::testing::Contains(HasSubstr("different orientations at the start"))));
  EXPECT_NEAR(std::abs(level.channel("forces/bushing_moment/hydrostatic/x").front()), 13963.0, 1.0);
}

// A massless knot that starts 0.47 J away from its balance: told once, and not counted as lost.
TEST(EnergyReport, AMasslessStartOutOfBalanceIsNamed) {
  const Trial trial("fail6_massless_start");
  EXPECT_THAT(trial.report().notes, ::testing::Contains(HasSubstr("the initial state is not in equilibrium")));
  EXPECT_THAT(trial.report().doubts, IsEmpty());
}

// `accuracy.of` takes a channel of joints also where `output.channels` is given.
TEST(Accuracy, OfAJointBesideChosenChannels) {
  const Trial trial("accuracy_channel");
  EXPECT_EQ(trial.report().outcome, RunOutcome::completed);
  EXPECT_GT(trial.channel("joints/coordinate/hinge").size(), 100u);
}

// A bushing whose stiffness is diagonal in axes of the plane, 0.5 m from the ground's origin along the normal; likewise
// one of no stiffness out of an oblique plane. In the plane it moves as in space.
TEST(PlanarBushing, OffTheOrigin) {
  const std::vector<std::vector<std::string>> cases{
      {},
      {"joints.h.axis=[1, 2, 3]", "bushings.bu.axis=[1, 2, 3]", "bushings.bu.x_axis=[3, 0, -1]",
       "loads.m.value=[1, 2, 3]", "bushings.bu.stiffness=[1000, 1500, 0, 0, 0, 3]"}};
  for (std::vector<std::string> settings : cases) {
    const Trial plane("planar_bushing_off_origin", settings);
    settings.push_back("effects={planar: off}");
    const Trial space("planar_bushing_off_origin", settings);
    const double turned = space.last("joints/coordinate/h/angle");
    EXPECT_GT(std::abs(turned), 1e-4);
    EXPECT_NEAR(plane.last("joints/coordinate/h/angle"), turned, 1e-10);
  }
}

// A folded guess with a length that is given: the triangle of 0.5, 0.5 and 0.4 m closes one way or the other, 47.156
// degrees from folded. In its plane, too.
TEST(Assembly, AFoldedGuessCloses) {
  for (const std::vector<std::string>& settings : {std::vector<std::string>{}, {"effects={planar: on}"}}) {
    const Trial trial("assembly_folded", settings);
    EXPECT_EQ(trial.report().outcome, RunOutcome::completed);
    EXPECT_NEAR(std::abs(trial.last("joints/coordinate/elbow")) * 180.0 / pi, 2.0 * std::asin(0.4) * 180.0 / pi, 1e-6);
  }
}

// Springs, stops and bushings of zero stiffness rest, with one note.
TEST(ZeroValues, RestWithANote) {
  const Trial trial("fail7_zero_values");
  EXPECT_EQ(trial.report().outcome, RunOutcome::completed);
  EXPECT_THAT(trial.report().notes,
              ::testing::Contains(
                  "elements without force, because all their values are zero: spring 's', spring 't', bushing 'b'"));
}

// A cruciform column of beams buckles in torsion at G (t/b)² A = 51.7 kN (shells: 53.2 kN), far below its Euler load.
TEST(TorsionalBuckling, CruciformColumn) {
  if (!has_reducer()) GTEST_SKIP() << "built without the reducer, which makes the superelements";
  const test_support::TemporaryFolder folder;
  const std::string file = "bodies.c.file=" + reduce("cruciform_beams", folder);
  const auto modes_that_grow = [&](double load) {
    const Trial trial("cruciform", {file, fmt::format("loads.p.value.0={}", -load)});
    return ::testing::PrintToString(trial.report().notes);
  };
  EXPECT_THAT(modes_that_grow(50.5e3), ::testing::Not(HasSubstr("grow")));
  EXPECT_THAT(modes_that_grow(53.0e3), HasSubstr("grow"));
}

// A channel of 2 m, hinged: weak axis at 125.3 kN, flexural-torsional at 203.3 kN (without warping, which beams do not
// have).
TEST(TorsionalBuckling, ChannelColumn) {
  if (!has_reducer()) GTEST_SKIP() << "built without the reducer, which makes the superelements";
  const test_support::TemporaryFolder folder;
  const std::string file = "bodies.c.file=" + reduce("channel_column", folder);
  const auto notes = [&](double load) {
    const Trial trial("channel_column", {file, fmt::format("loads.p.value.0={}", -load)});
    return ::testing::PrintToString(trial.report().notes);
  };
  EXPECT_THAT(notes(124e3), ::testing::Not(HasSubstr("grow")));
  EXPECT_THAT(notes(200e3), HasSubstr("1 mode grows"));
  EXPECT_THAT(notes(207e3), HasSubstr("2 modes grow"));
}

// Every elastic mode of a free body has the ratio a/(2ω) of `damping: {mass: a}`, whatever its frame: 0.003077 at 51.7
// Hz.
TEST(MassDamping, DoesNotDependOnTheFrame) {
  if (!has_reducer()) GTEST_SKIP() << "built without the reducer, which makes the superelements";
  const test_support::TemporaryFolder folder;
  const std::string file = "bodies.s.file=" + reduce("bar", folder);
  for (const std::string frame : {"frame=karcher", "frame={node: base}", "frame={node: tip}"}) {
    const Trial trial("mass_damping", {file, "bodies.s." + frame});
    const std::vector<double> f = trial.frequencies(), ratio = trial.channel("modes/damping_ratio");
    for (std::size_t k = 0; k < f.size(); ++k)
      if (f[k] > 1.0) {
        EXPECT_NEAR(ratio[k] * 2.0 * 2.0 * pi * f[k] / 2.0, 1.0, 1e-6) << frame << ' ' << f[k];
      }
  }
}

// A drive whose acceleration jumps: a rigid body, I = 0.18, I α = 0.960 N m from the jump on.
TEST(Drives, MomentOfAJumpOfAcceleration) {
  for (const char* step : {"1e-3", "1e-4"}) {
    const Trial trial("drive_jumps", {std::string("integrator.step=") + step});
    const std::vector<double> t = trial.time(), moment = trial.channel("motions/force/m");
    for (std::size_t i = 0; i < t.size(); ++i)
      if (t[i] > 0.1001 && t[i] < 0.3) {
        EXPECT_NEAR(std::abs(moment[i]), 0.960, 1e-3) << t[i];
      }
  }
  // A drive that begins with the run: I π²/2 = 0.4935 in row 0.
  for (const char* method :
       {"integrator.method=generalised_alpha", "integrator.method=radau", "analysis=inverse_dynamics"})
    EXPECT_NEAR(std::abs(Trial("drive_starts", {method}).channel("motions/force/m").front()), 0.4935, 1e-3) << method;
}

// A modal body whose flexibility is off is rigid: inverse dynamics takes it. Drive at the start: m g L/2 = 7.6518 N m.
TEST(InverseDynamics, OfAModalBodyWithoutModes) {
  if (!has_reducer()) GTEST_SKIP() << "built without the reducer, which makes the modal body";
  const test_support::TemporaryFolder folder;
  reduce("bar", folder);
  const Trial trial("modal_rigid_inverse", {"bodies.mf.file=" + folder.file("bar.modal.h5")});
  EXPECT_EQ(trial.report().outcome, RunOutcome::completed);
  EXPECT_NEAR(trial.channel("motions/force/dm").front(), -7.6518, 1e-4);
}

// A hinge with friction, and a beam without rotary inertia that nothing connects with it: each alone ran. The weight
// of 9.81 N acts 0.1 m from the hinge, which holds by friction (coefficient 0.2, radius 0.02 m) 0.04 N m of 0.981: it
// starts with (0.981 - 0)/(0.01 + 0.01) rad/s².
TEST(Friction, BesideABodyWithoutInertia) {
  const Trial trial("friction_massless");
  EXPECT_EQ(trial.report().outcome, RunOutcome::completed);
  EXPECT_NEAR(trial.channel("nodes/acceleration/p/z").front(), 0.0, 1e-9);
  EXPECT_NEAR(trial.channel("nodes/angular_acceleration/p/y").front(), 0.981 / 0.02, 1e-6);
}

// Slider-crank with friction 0.6: drive 3.98782 N m at the start (closed form; row 0 of dynamics gives it).
TEST(InverseDynamics, FrictionOfTheFirstRow) {
  EXPECT_NEAR(std::abs(Trial("inverse_friction").channel("motions/force/d").front()), 3.98782, 1e-4);
}

// A free beam moves as well 200 m away as at the origin.
TEST(FarScenes, NewtonEndsAtTheRoundingOfPositions) {
  const Trial trial("far_beam", {"bodies.b.velocity.0=10"});
  EXPECT_EQ(trial.report().rejected, 0);
  EXPECT_LT(trial.report().iterations, 1.75 * trial.report().steps);
}

// Under tension of 9 times its buckling load the shapes of a blade's ends are too stiff by 7 %, in spite of the
// companion file. With internal modes nothing is doubted.
TEST(CompanionsWithoutModes, TensionIsDoubted) {
  if (!has_reducer()) GTEST_SKIP() << "built without the reducer, which makes the superelements";
  const test_support::TemporaryFolder folder;
  const auto doubts = [&](const std::string& modes) {
    const std::string file = "bodies.blade.file=" + reduce("blade_end_shapes", folder, "--set modes=" + modes);
    return Trial("blade_end_shapes", {file}).report().doubts;
  };
  EXPECT_THAT(doubts("0"),
              ::testing::ElementsAre(HasSubstr("but has no internal modes. Its stiffness has an error of up to")));
  EXPECT_THAT(doubts("4"), IsEmpty());
}

// A hub with two damped panels is spun up in 60 s and turns on. Damping takes what moves the panels, not what turns
// them: less than the energy loses (in which the scheme's own loss is). By the rates of the nodes it was 27 times the
// loss.
TEST(FreeFlight, DampingTakesWhatTheEnergyLoses) {
  if (!has_reducer()) GTEST_SKIP() << "built without the reducer, which makes the superelements";
  const test_support::TemporaryFolder folder;
  const std::string panel = reduce("satellite", folder);
  const Trial trial("satellite", {"bodies.p.file=" + panel, "bodies.q.file=" + panel, "integrator.end=80"});
  EXPECT_THAT(trial.report().doubts, IsEmpty());
  const double lost = trial.last("energy/work") - trial.last("energy/total"),
               dissipated = trial.last("energy/dissipated");
  EXPECT_GT(dissipated, 0.0);
  EXPECT_LT(dissipated, lost);
  EXPECT_LT(lost, 4e-4 * trial.last("energy/total"));
  // A checkpoint forgets the step before; the step after it counts as all others. The motion itself differs by 4e-8:
  // the position projection begins with new factors.
  const Trial stopped("satellite", {"bodies.p.file=" + panel, "bodies.q.file=" + panel, "integrator.end=80",
                                    "checkpoint={every: 400}"});
  EXPECT_NEAR(stopped.last("energy/dissipated"), dissipated, 0.01 * dissipated);
}

// What no load acts on keeps its angular momentum; steps of index 2 lose some of that of a turning flexible body.
TEST(FreeFlight, LostAngularMomentumIsReported) {
  if (!has_reducer()) GTEST_SKIP() << "built without the reducer, which makes the superelements";
  const test_support::TemporaryFolder folder;
  const std::string panel = reduce("satellite", folder);
  const Trial trial("satellite",
                    {"bodies.p.file=" + panel, "bodies.q.file=" + panel, "integrator={step: 0.03, end: 400}"});
  EXPECT_THAT(trial.report().doubts, Contains(HasSubstr("angular momentum changes by")));
}

// A moment turns a free body: what acts from outside is no loss, whatever the method, and where rows lie between steps.
TEST(FreeFlight, MomentumThatLoadsChangeIsNotReported) {
  for (const std::string method :
       {"{step: 0.002, end: 5}", "{method: radau, step: auto, end: 5, error_control: {tolerance: 1e-6}}",
        "{step: auto, end: 5, error_control: {tolerance: 1e-4}}", "{method: bdf, end: 5}"})
    for (const std::string moment : {"1", "{expression: 't > 1.02 && t < 1.03 ? 60 : 0'}", "'sin(3 * t)'"})
      EXPECT_THAT(
          Trial("turned_body", {"integrator=" + method, "loads.m.value=[" + moment + ", 0, 0]"}).report().doubts,
          IsEmpty())
          << method << " " << moment;
}

// The largest force of pin B of an undamped parallelogram is 818, 424 and 16 326 N with steps of 1e-3, 2.5e-4 and 1e-4
// s; with 5 % of damping 349 and 353 N.
TEST(ReactionVibration, OfBodiesThatNothingDampsIsReported) {
  if (!has_reducer()) GTEST_SKIP() << "built without the reducer, which makes the superelements";
  const test_support::TemporaryFolder folder;
  const std::string file = "bodies.b.file=" + reduce("parallelogram", folder);
  for (const char* integrator : {"{step: 1e-3, end: 3}", "{step: 2.5e-4, end: 1}"})
    EXPECT_THAT(Trial("parallelogram", {file, fmt::format("integrator={}", integrator)}).report().doubts,
                Contains(HasSubstr("reactions vibrate with 'b', which has no damping")))
        << integrator;
  EXPECT_THAT(Trial("parallelogram", {file, "parameters.zeta=0.05"}).report().doubts, IsEmpty());
}

// Euler's equations, solved with order 8 and a tolerance of 1e-13: the rate about the middle axis changes its sign 57
// times in 1000 s. radau changes energy by 1e-7, which shifts that by a turn or two, and says so; each turn has two
// changes of sign.
TEST(Tumbling, ChangedPeriodIsReported) {
  const auto turns_over = [](const Trial& trial) {
    std::vector<std::vector<double>> values;
    for (const char* name : {"rotation/n/w", "rotation/n/x", "rotation/n/y", "rotation/n/z", "angular_velocity/n/x",
                             "angular_velocity/n/y", "angular_velocity/n/z"})
      values.push_back(trial.channel(fmt::format("nodes/{}", name)));
    int count = 0;
    double before = 0.0;
    for (std::size_t k = 0; k < values[0].size(); ++k) {
      const Eigen::Quaterniond turn(values[0][k], values[1][k], values[2][k], values[3][k]);
      const double rate =
          (turn * Eigen::Vector3d::UnitY()).dot(Eigen::Vector3d(values[4][k], values[5][k], values[6][k]));
      if (rate * std::exchange(before, rate) < 0.0) ++count;
    }
    return count;
  };
  const Trial coarse("tumbling_body");
  EXPECT_NE(turns_over(coarse), 57);
  EXPECT_THAT(coarse.report().doubts, ElementsAre(HasSubstr("the tumbling of 'n' has an error of about 1.2 turns")));
  const Trial coarser("tumbling_body", {"integrator={method: bdf, end: 1000, relative_tolerance: 1e-5, "
                                        "absolute_tolerance: 1e-5}"});
  EXPECT_NE(turns_over(coarser), 57);
  EXPECT_THAT(coarser.report().doubts, ElementsAre(HasSubstr("the tumbling of 'n' has an error of about")));
  for (const char* setting : {"integrator.error_control.tolerance=1e-11", "integrator={step: 0.01, end: 1000}",
                              "integrator={method: bdf, end: 1000}"}) {
    const Trial fine("tumbling_body", {setting});
    EXPECT_EQ(turns_over(fine), 57) << setting;
    EXPECT_THAT(fine.report().doubts, IsEmpty()) << setting;
  }
}

// Exactly on its middle axis a body stays there, and rounding is no tumbling.
TEST(Tumbling, OfTheMiddleAxisIsNoRounding) {
  for (const char* integrator : {"{step: 0.01, end: 1000}", "{method: bdf, end: 1000}",
                                 "{method: radau, step: auto, end: 1000, error_control: {tolerance: 1e-9}}"}) {
    const Trial trial("tumbling_body", {"bodies.n.inertia=[1.1, 2.7, 3.3]", "bodies.n.angular_velocity=[0, 2.1, 0]",
                                        fmt::format("integrator={}", integrator)});
    EXPECT_NEAR(trial.last("nodes/angular_velocity/n/y"), 2.1, 1e-3) << integrator;
    EXPECT_THAT(trial.report().doubts, IsEmpty()) << integrator;
  }
}

}  // namespace
}  // namespace tisserand::mechanism::trials_test

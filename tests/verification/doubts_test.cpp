// SPDX-License-Identifier: GPL-3.0-or-later
// Validity checks of runs: each warning is provoked, and absent where the answer is right.
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mechanism/doubts/balances.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::doubts_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using std::numbers::pi;
using test_support::BeamData;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

RunReport run(const formats::Scene& scene, const BodyFiles& files = {}) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.file("a.results.h5");
  return simulate(RunRequest{scene, files, std::nullopt, path, "", std::nullopt}, RunControl{}).report;
}

/// Warnings from a run from 0 to 80 with kinetic energy 1 and the given balance.
template <class Balance>
std::vector<std::string> reported_by(Balance balance) {
  EnergyBalance energy(0.0, 80.0);
  formats::ResultsRow row;
  row.kinetic = row.total = 1.0;
  for (int i = 0; i <= 80; ++i) {
    row.time = i;
    row.balance = balance(row.time);
    energy.observe(row, 0.0);
  }
  return energy.doubts("", Units{});
}

TEST(EnergyDoubt, SpeaksBeyondAHundredthOfWhatMoved) {
  EXPECT_THAT(reported_by([](double t) { return t < 40 ? 0.0 : -0.02; }),
              ElementsAre(AllOf(HasSubstr("the error of the energy balance is 0.02 of the largest energy or work"),
                                HasSubstr("Energy was lost without a physical cause"))));
  EXPECT_THAT(reported_by([](double t) { return 0.009 * std::sin(t); }), IsEmpty());
}

// A growing force on a body that a fixed joint holds: its energies are round-off, and so is their imbalance.
TEST(EnergyDoubt, IsSilentWhereNothingMoves) {
  formats::Scene scene = test_support::empty_scene(0.001, 1.0);
  formats::RigidBodySpec body = test_support::rigid_body("body", 0.19, {0.1524, 0, 0}, {1e-6, 1.5e-3, 1.5e-3});
  body.nodes.push_back({"tip", {{0.3048, 0, 0}, Eigen::Quaterniond::Identity()}});
  scene.bodies.emplace_back(body);
  scene.joints = {test_support::joint("weld", formats::JointKind::fixed, "ground", "body", {0, 0, 0}, {0, 0, 1})};
  formats::LoadSpec load = test_support::constant_load("tip", formats::LoadKind::force, "body/tip", {0, 0, 0});
  load.components[1] = formats::TimeExpression{"0.02 * (1 + 4 * t)", {}, "here"};
  scene.loads = {load};
  EXPECT_THAT(run(scene).doubts, IsEmpty());
}

TEST(EnergyDoubt, SpeaksOfASteadyDrift) {
  EXPECT_THAT(reported_by([](double t) { return 5e-5 * t; }), ElementsAre(HasSubstr("steadily gained")));
  EXPECT_THAT(reported_by([](double t) { return 5e-6 * t; }), IsEmpty());  // 4e-4: far from the tolerance
  EXPECT_THAT(reported_by([](double t) { return 4e-3 * (1.0 - std::exp(-t / 5.0)); }), IsEmpty());  // settles
}

TEST(StepDoubt, SpeaksWhereAPeriodHasFewSteps) {
  // A period of 2.3 s: 230 and 8 steps.
  const auto with_step = [](double step) {
    formats::Scene scene = test_support::pendulum_scene(step, 20.0);
    return run(scene).doubts;
  };
  EXPECT_THAT(with_step(0.01), IsEmpty());
  EXPECT_THAT(::testing::PrintToString(with_step(0.3)), HasSubstr("does not resolve the motion"));
}

// A pendulum that is thrown round at 10 rad/s: 0.1 and 2 rad per step.
TEST(TurnDoubt, SpeaksBeyondAQuarterOfARevolutionPerStep) {
  const auto with_step = [](double step) {
    formats::Scene scene = test_support::empty_scene(step, 100 * step);
    formats::RigidBodySpec rotor = test_support::rigid_body("rotor", 1, {0, 0, 0}, {1, 1, 1});
    rotor.start.angular_velocity = Vector3d(0, 0, 10);
    scene.bodies = {rotor};
    scene.joints = {
        test_support::joint("axle", JointKind::revolute, "ground", "rotor", Vector3d::Zero(), Vector3d::UnitZ())};
    return run(scene).doubts;
  };
  EXPECT_THAT(with_step(0.01), IsEmpty());
  EXPECT_THAT(::testing::PrintToString(with_step(0.2)), HasSubstr("'rotor' turns by 2 rad per step"));
}

// Two hinges on one axis hold what one holds.
TEST(ReactionDoubt, SpeaksOfTwoHingesOnOneAxis) {
  formats::Scene scene = test_support::pendulum_scene(0.01, 0.1);
  scene.joints.push_back(scene.joints.front());
  scene.joints.back().name = "again";
  const RunReport report = run(scene);
  EXPECT_THAT(report.doubts, IsEmpty());  // the motion is right
  EXPECT_THAT(::testing::PrintToString(report.notes), HasSubstr("again are not unique"));
}

TEST(MultiplierDoubt, SpeaksOfIndex3WithoutDamping) {
  formats::Scene scene = test_support::pendulum_scene(0.002, 5.0);
  scene.integrator.formulation = formats::Formulation::index3;
  scene.integrator.rho = 0.9;
  EXPECT_THAT(run(scene).doubts, IsEmpty());
  scene.integrator.rho = 1.0;
  const RunReport report = run(scene);
  EXPECT_THAT(::testing::PrintToString(report.doubts) + report.reason,
              HasSubstr("the Lagrange multipliers oscillate from step to step"));
}

/// The beam as a superelement of four modes, held by a joint at its base.
struct HeldBeam {
  BeamData beam;
  BodyFiles files;
  formats::Scene scene = test_support::empty_scene(1e-3, 0.05);
  explicit HeldBeam(JointKind kind, const BeamData& data = {}) : beam(data) {
    test_support::add_file("beam", test_support::craig_bampton_beam(beam, 4), files.superelements);
    scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
    scene.joints.push_back(
        test_support::joint("base", kind, "ground", "beam/base", Vector3d::Zero(), Vector3d::UnitZ()));
  }
  /// Angular frequency of a cantilever that bends about its weaker axis, 3.5160 √(EI/(m L³)).
  double cantilever() const {
    return 3.5160 * std::sqrt(beam.young * beam.Iy / (beam.density * beam.area * std::pow(beam.length, 4)));
  }
  /// Euler's buckling load between pins.
  double buckling() const { return pi * pi * beam.young * beam.Iy / (beam.length * beam.length); }
};

TEST(SpinDoubt, SpeaksNearTheFirstFrequency) {
  for (const double share : {0.2, 0.5}) {
    HeldBeam held(JointKind::revolute);
    auto& body = std::get<formats::SuperelementBodySpec>(held.scene.bodies.front());
    body.start.angular_velocity = Vector3d(0, 0, share * held.cantilever());
    const std::vector<std::string> doubts = run(held.scene, held.files).doubts;
    if (share > 0.29)
      EXPECT_THAT(doubts, Contains(HasSubstr("'beam' spins at 0.5 of its first frequency")));
    else
      EXPECT_THAT(doubts, IsEmpty());
  }
}

TEST(AxialDoubt, SpeaksFromATenthOfTheBucklingLoad) {
  for (const double share : {-0.2, -0.05, 0.05, 0.2}) {
    HeldBeam held(JointKind::fixed);
    held.scene.analysis = formats::AnalysisKind::statics;
    held.scene.loads.push_back(test_support::constant_load("axial", formats::LoadKind::force, "beam/tip",
                                                           Vector3d(share * held.buckling(), 0, 0)));
    const std::vector<std::string> doubts = run(held.scene, held.files).doubts;
    if (std::abs(share) > 0.1)
      EXPECT_THAT(doubts,
                  ElementsAre(HasSubstr(share > 0 ? "tension of 0.2 of its buckling load" : "compression of 0.2")));
    else
      EXPECT_THAT(doubts, IsEmpty());
  }
}

TEST(DeflectionDoubt, SpeaksFromAFifthOfTheLength) {
  for (const double share : {0.02, 0.3}) {
    HeldBeam held(JointKind::fixed);
    held.scene.analysis = formats::AnalysisKind::statics;
    const double force = share * 3.0 * held.beam.young * held.beam.Iy / std::pow(held.beam.length, 2);
    std::get<formats::SuperelementBodySpec>(held.scene.bodies.front()).frame = formats::FrameKind::node;
    std::get<formats::SuperelementBodySpec>(held.scene.bodies.front()).frame_node = "base";
    held.scene.loads.push_back(
        test_support::constant_load("across", formats::LoadKind::force, "beam/tip", Vector3d(0, 0, force)));
    const std::string doubts = ::testing::PrintToString(run(held.scene, held.files).doubts);
    EXPECT_EQ(doubts.find("of its length") != std::string::npos, share > 0.2) << doubts;
  }
}

/// Run of two halves of a beam of 2 m that turn at `rate` on a hinge at the root. Their torsional stiffness is divided
/// by `softer`.
RunReport run_of_blade(double rate, double softer, formats::InertiaOption inertia, double end) {
  BeamData half;
  half.length = 1.0, half.Iy = half.Iz = 2e-8, half.J = 4e-8 / softer;
  BodyFiles files;
  test_support::add_file("half", test_support::craig_bampton_beam(half, 6), files.superelements);
  formats::Scene scene = test_support::empty_scene(1e-3, end);
  for (const auto& [name, at] : {std::pair{"inner", 0.0}, {"outer", 1.0}}) {
    formats::SuperelementBodySpec body = test_support::superelement_body(name, "half");
    body.inertia = inertia;
    body.start.pose.position = {at, 0, 0};
    body.start.velocity = Vector3d(0, rate * at, 0);
    body.start.angular_velocity = Vector3d(0, 0, rate);
    scene.bodies.push_back(body);
  }
  const Vector3d z = Vector3d::UnitZ();
  scene.joints = {test_support::joint("root", JointKind::revolute, "ground", "inner/base", {0, 0, 0}, z),
                  test_support::joint("weld", JointKind::fixed, "inner/tip", "outer/base", {1, 0, 0}, z)};
  return run(scene, files);
}

TEST(TorsionDoubt, SpeaksOfWeldedPiecesThatAreSoftForTheirSpin) {
  using enum formats::InertiaOption;
  const auto reported = [](double softer, formats::InertiaOption inertia) {
    return ::testing::PrintToString(run_of_blade(10, softer, inertia, 0.05).doubts);
  };
  for (const formats::InertiaOption option : {B, M}) {
    EXPECT_THAT(reported(1, option), Not(HasSubstr("soft in torsion")));
    EXPECT_THAT(reported(1e3, option), HasSubstr("is too soft in torsion for its spin"));
  }
  EXPECT_THAT(reported(1e3, A), Not(HasSubstr("soft in torsion")));
}

/// Warnings for the beam on a joint of `kind`. It turns about z, and a force along z makes it move in space.
std::vector<std::string> doubts_of_ball_joint(JointKind kind, formats::InertiaOption inertia, bool has_bob = false) {
  BeamData round;
  round.Iy = round.Iz = 1.5e-8;
  HeldBeam held(kind, round);
  held.scene.integrator.end = 2.0;
  auto& body = std::get<formats::SuperelementBodySpec>(held.scene.bodies.front());
  body.inertia = inertia;
  body.start.angular_velocity = Vector3d(0, 0, 1);
  if (has_bob) {
    formats::RigidBodySpec bob = test_support::rigid_body("bob", 1e-2, {0, 0, 0}, {1e-7, 1e-7, 1e-7});
    bob.start.pose.position = {round.length, 0, 0};
    held.scene.bodies.push_back(bob);
    held.scene.joints.push_back(
        test_support::joint("end", JointKind::fixed, "beam/tip", "bob", {round.length, 0, 0}, Vector3d::UnitZ()));
  }
  held.scene.loads.push_back(
      test_support::constant_load("lift", formats::LoadKind::force, "beam/tip", Vector3d(0, 0, 20)));
  return run(held.scene, held.files).doubts;
}

TEST(AxialSpinDoubt, SpeaksOfABentBeamThatCanTurnAboutItsAxis) {
  using enum formats::InertiaOption;
  EXPECT_THAT(::testing::PrintToString(doubts_of_ball_joint(JointKind::spherical, A)),
              HasSubstr("'beam' spins about its own axis"));
  // A body that only the beam holds does not prevent the spin.
  EXPECT_THAT(::testing::PrintToString(doubts_of_ball_joint(JointKind::spherical, A, true)),
              HasSubstr("'beam' spins about its own axis"));
  EXPECT_THAT(::testing::PrintToString(doubts_of_ball_joint(JointKind::revolute, A)),
              Not(HasSubstr("spins about its own axis")));
}

/// A rod of steel, 1 m long and 2 cm across, as a modal body that is clamped at its start.
struct ModalRod {
  static constexpr double E = 2.1e11, I = pi / 4 * 1e-8, mass = 7800 * pi * 1e-4;
  BodyFiles files;
  formats::Scene scene = test_support::empty_scene(1e-3, 0.1);
  explicit ModalRod(JointKind kind) {
    test_support::Rod rod{0.0, 1.0, pi * 1e-4, E, E / 2.6, I, 7800, 16};
    files.modal_bodies["rod"].body =
        test_support::modal_body(test_support::lumped_rod(rod), {{0, 0, 0, 0, 0, 0}, {0, 1, 2, 3, 4, 5}}, 6);
    formats::ModalBodySpec body;
    body.name = body.file = "rod";
    scene.bodies.push_back(body);
    scene.joints.push_back(test_support::joint("base", kind, "ground", "rod/n0", Vector3d::Zero(), Vector3d::UnitZ()));
  }
  void statics(const Vector3d& force) {
    scene.analysis = formats::AnalysisKind::statics;
    scene.loads.push_back(test_support::constant_load("tip", formats::LoadKind::force, "rod/n16", force));
  }
};

TEST(ModalRangeDoubt, SpeaksOfAxialForceDeflectionAndSpin) {
  for (const double share : {-0.2, -0.05, 0.05, 0.2}) {
    ModalRod rod(JointKind::fixed);
    rod.statics({share * pi * pi * ModalRod::E * ModalRod::I, 0, 0});
    const std::string reported = ::testing::PrintToString(run(rod.scene, rod.files).doubts);
    EXPECT_EQ(reported.find(share > 0 ? "tension of 0.2 of its buckling" : "compression of 0.2 of its buckling") !=
                  std::string::npos,
              std::abs(share) > 0.1)
        << reported;
  }
  for (const double share : {0.02, 0.3}) {
    ModalRod rod(JointKind::fixed);
    rod.statics({0, 0, share * 3.0 * ModalRod::E * ModalRod::I});
    const std::string reported = ::testing::PrintToString(run(rod.scene, rod.files).doubts);
    EXPECT_EQ(reported.find("deflects by") != std::string::npos, share > 0.2) << reported;
  }
  for (const int k : {0, 1, 2, 3}) {
    const double share = k % 2 == 0 ? 0.2 : 0.5;
    ModalRod rod(JointKind::revolute);
    rod.scene.effects = {{formats::Effect::planar, "", k > 1, "switch"}};
    std::get<formats::ModalBodySpec>(rod.scene.bodies.front()).start.angular_velocity =
        Vector3d(0, 0, share * 3.5160 * std::sqrt(ModalRod::E * ModalRod::I / ModalRod::mass));
    const std::string reported = ::testing::PrintToString(run(rod.scene, rod.files).doubts);
    EXPECT_EQ(reported.find("'rod' spins at 0.5") != std::string::npos, share > 0.29) << reported;
  }
}

/// Warnings for the slider-crank of [GA00] 4.3 with its rod as one superelement, driven at a constant rate.
std::vector<std::string> doubts_of_slider_crank(double rate, formats::InertiaOption inertia) {
  constexpr double r = 0.1524, l = 0.3048;
  BeamData rod;
  rod.length = l, rod.young = 2.068e11, rod.density = 7820, rod.area = 3.16e-5;
  rod.Iy = rod.Iz = 7.946e-11, rod.J = 2 * rod.Iy, rod.shear_modulus = rod.young / 2.6;
  BodyFiles files;
  test_support::add_file("beam", test_support::craig_bampton_beam(rod, 6), files.superelements);
  formats::Scene scene = test_support::empty_scene(1e-4 * 124.8 / rate, 0.03 * 124.8 / rate);
  formats::RigidBodySpec crank = test_support::rigid_body("crank", 10, {0, 0, 0}, {0.02, 0.02, 0.02});
  crank.nodes.push_back({"pin", {{r, 0, 0}, Eigen::Quaterniond::Identity()}});
  scene.bodies.push_back(crank);
  formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
  body.start.pose.position = {r, 0, 0};
  body.inertia = inertia;
  scene.bodies.push_back(body);
  const Vector3d z = Vector3d::UnitZ();
  formats::JointSpec slider = test_support::joint("slider", JointKind::generic, "ground", "beam/tip", {r + l, 0, 0}, z);
  slider.hold = {false, true, true, false, false, false};
  scene.joints = {test_support::joint("main", JointKind::revolute, "ground", "crank", {0, 0, 0}, z),
                  test_support::joint("pin", JointKind::revolute, "crank/pin", "beam/base", {r, 0, 0}, z), slider};
  scene.motions = {test_support::drive("main", fmt::format("{}*t", rate))};
  return run(scene, files).doubts;
}

// Against exact beams the rod errs by 18.8 % with A and B, by 8.9 % with M (examples/inertia_options). SpinDoubt shows
// that bodies that turn without translating cause no such warning.
TEST(InertiaDoubt, SpeaksOfARodThatTurnsWhileItTranslates) {
  using enum formats::InertiaOption;
  for (const auto& [option, other] : {std::pair{A, "M in place of A"}, {B, "M in place of B"}})
    EXPECT_THAT(::testing::PrintToString(doubts_of_slider_crank(124.8, option)), HasSubstr(other));
  EXPECT_THAT(doubts_of_slider_crank(12.48, M), IsEmpty());
}

TEST(DampingDoubt, SpeaksWhereTheLowestModeHasNone) {
  HeldBeam held(JointKind::fixed);
  auto& body = std::get<formats::SuperelementBodySpec>(held.scene.bodies.front());
  body.damping.ratio_internal = 0.02;
  EXPECT_THAT(run(held.scene, held.files).doubts,
              ElementsAre(HasSubstr("damping of 'beam' has almost no effect on its lowest mode")));
  body.damping = {};
  body.damping.ratio = 0.02;  // of the free beam, whose lowest mode is 6.4 times as high as that of the cantilever
  EXPECT_THAT(run(held.scene, held.files).notes, Contains(HasSubstr("in the modes of the body without joints")));
}

/// Run of a crank of 1 m that drives a slider through a rod of length `rod`. If rod < 1 m it locks at asin(rod).
RunReport run_of_crank(double rod, formats::IntegratorSpec integrator, double end = 1.0) {
  const Vector3d z = Vector3d::UnitZ();
  formats::Scene scene = test_support::empty_scene(integrator.step, end);
  integrator.end = end;
  scene.integrator = integrator;
  formats::RigidBodySpec crank = test_support::rigid_body("crank", 1, {0, 0, 0}, {0.1, 0.1, 0.1});
  crank.nodes.push_back({"pin", {{1, 0, 0}, Eigen::Quaterniond::Identity()}});
  formats::RigidBodySpec link = test_support::rigid_body("rod", 1, {0, 0, 0}, {0.001, 0.05, 0.05});
  link.start.pose.position = {1, 0, 0};
  link.nodes.push_back({"end", {{rod, 0, 0}, Eigen::Quaterniond::Identity()}});
  scene.bodies = {crank, link};
  formats::JointSpec slider =
      test_support::joint("slider", JointKind::generic, "ground", "rod/end", {1 + rod, 0, 0}, z);
  slider.hold = {false, true, false, false, false, false};
  scene.joints = {test_support::joint("main", JointKind::revolute, "ground", "crank", {0, 0, 0}, z),
                  test_support::joint("pin", JointKind::revolute, "crank/pin", "rod", {1, 0, 0}, z), slider};
  scene.motions = {test_support::drive("main", "t")};
  return run(scene);
}

TEST(FailureCause, IsADriveThatLeavesWhatTheMechanismCanReach) {
  formats::IntegratorSpec integrator;
  integrator.step = 1e-3;
  const RunReport locked = run_of_crank(0.5, integrator);
  EXPECT_EQ(locked.outcome, RunOutcome::not_converged);
  EXPECT_THAT(locked.reason, HasSubstr("The drive demands a position that the mechanism cannot reach"));
  EXPECT_THAT(locked.reason, HasSubstr("t = 0.5235"));  // asin(1/2)
  EXPECT_EQ(run_of_crank(1.1, integrator).outcome, RunOutcome::completed);
}

// Two four-bars side by side, which lie flat at t = 0.7144: fixed steps of radau cannot pass, generalised alpha does.
TEST(FailureCause, IsASingularPosition) {
  const auto with_method = [](const std::string& method) {
    return run(formats::read_scene(TISSERAND_SOURCE_DIR "/tests/stability/scenes/four_bar.scene.yaml",
                                   {{"integrator.method", method}, {"integrator.end", "1"}}));
  };
  const RunReport report = with_method("radau");
  EXPECT_THAT(report.reason, HasSubstr("t = 0.714"));
  EXPECT_THAT(report.reason, HasSubstr("constraint equations are nearly dependent there"));
  EXPECT_EQ(with_method("generalised_alpha").outcome, RunOutcome::completed);
}

/// Run of a block of 1 kg that slides along z at 1 m/s, with a spring on its slide.
RunReport run_of_slide(const formats::SpringSpec& spring, const formats::IntegratorSpec& integrator) {
  formats::Scene scene = test_support::empty_scene(integrator.step, 1.0);
  scene.integrator = integrator;
  scene.integrator.end = 1.0;
  formats::RigidBodySpec block = test_support::rigid_body("block", 1, {0, 0, 0}, {1, 1, 1});
  block.start.velocity = Vector3d(0, 0, 1);
  scene.bodies = {block};
  scene.joints = {
      test_support::joint("slide", JointKind::prismatic, "ground", "block", Vector3d::Zero(), Vector3d::UnitZ())};
  scene.springs = {spring};
  scene.springs.back().name = "spring";
  scene.springs.back().coordinate = formats::CoordinateRef{"slide", ""};
  return run(scene);
}

/// Integrator with one attempt per step and few iterations.
formats::IntegratorSpec impatient(double step) {
  formats::IntegratorSpec integrator;
  integrator.step = step;
  integrator.max_halvings = 0;
  integrator.max_iterations = 3;
  return integrator;
}

// m (1 - α_m)/((1 - α_f) β h²) + k = 0 with rho = 1: k = -4 m/h².
TEST(FailureCause, IsAStiffnessThatBalancesTheMass) {
  formats::IntegratorSpec integrator = impatient(0.01);
  integrator.rho = 1.0;
  formats::SpringSpec spring;
  spring.stiffness = -4.0 / (0.01 * 0.01);
  EXPECT_THAT(run_of_slide(spring, integrator).reason, HasSubstr("regular with a quarter of it. A negative stiffness"));
  spring.stiffness = -1.0;
  EXPECT_EQ(run_of_slide(spring, integrator).outcome, RunOutcome::completed);
}

// A needle without inertia about its hinge, on a spring that yields at 0.5 N m, under a moment of 1 N m/s.
TEST(FailureCause, IsADirectionWithoutMass) {
  const auto with_last = [](double last) {
    formats::Scene scene = test_support::empty_scene(0.01, 1.0);
    scene.integrator = impatient(0.01);
    scene.integrator.end = 1.0;
    formats::RigidBodySpec needle = test_support::rigid_body("needle", 1, {0, 0, 0}, {1, 1, 0});
    scene.bodies = {needle};
    scene.joints = {
        test_support::joint("axle", JointKind::revolute, "ground", "needle", Vector3d::Zero(), Vector3d::UnitZ())};
    formats::SpringSpec spring;
    spring.name = "spring";
    spring.coordinate = formats::CoordinateRef{"axle", ""};
    spring.stiffness =
        formats::CurveSpec{formats::Interpolation::linear, {-1.0, 0.0, 0.5, 1.5}, {-1.0, 0.0, 0.5, last}};
    spring.force = formats::TimeExpression{"t", {}, ""};
    scene.springs = {spring};
    return run(scene);
  };
  EXPECT_THAT(with_last(0.5).reason, HasSubstr("A direction has no mass, no stiffness and no constraint: needle"));
  EXPECT_EQ(with_last(1.5).outcome, RunOutcome::completed);
}

// A moment that jumps from zero to 1e9 N m in one step.
TEST(FailureCause, IsALoadThatSetsIn) {
  const auto with_moment = [](const std::string& moment) {
    formats::Scene scene = test_support::pendulum_scene(0.002, 1.0);
    scene.integrator = impatient(0.002);
    scene.integrator.end = 1.0;
    formats::LoadSpec load =
        test_support::constant_load("jump", formats::LoadKind::moment, "pendulum", Vector3d::Zero());
    load.components[2] = formats::TimeExpression{moment, {}, ""};
    scene.loads = {load};
    return run(scene);
  };
  EXPECT_THAT(with_moment("t < 0.1 ? 0 : 1e9").reason,
              HasSubstr("The cause begins within the step: a load, a stop or friction"));
  EXPECT_EQ(with_moment("t < 0.1 ? 0 : 1").outcome, RunOutcome::completed);
}

// A pendulum of 2.3 s with 15 steps per period, at its fastest.
TEST(FailureCause, IsAStepInWhichTheMotionChanges) {
  formats::Scene scene = test_support::pendulum_scene(0.15, 20.0);
  scene.integrator = impatient(0.15);
  scene.integrator.max_iterations = 4;
  scene.integrator.end = 20.0;
  EXPECT_THAT(run(scene).reason, HasSubstr("velocities changed by"));
  scene.integrator.step = 0.01;
  EXPECT_EQ(run(scene).outcome, RunOutcome::completed);
}

TEST(FailureCause, IsMultipliersThatSwing) {
  formats::Scene scene = test_support::pendulum_scene(2e-3, 100.0);
  scene.integrator = impatient(2e-3);
  scene.integrator.end = 100.0;
  scene.integrator.formulation = formats::Formulation::index3;
  scene.integrator.rho = 1.0;
  EXPECT_THAT(run(scene).reason, HasSubstr("the Lagrange multipliers oscillate from step to step"));
  scene.integrator.rho = 0.9;
  scene.integrator.end = 1.0;
  EXPECT_EQ(run(scene).outcome, RunOutcome::completed);
}

// Soft pieces that start at this spin turn over.
TEST(FailureCause, IsTorsionTooSoftForTheSpin) {
  using enum formats::InertiaOption;
  const RunReport soft = run_of_blade(40, 1e5, B, 2.0);
  EXPECT_EQ(soft.outcome, RunOutcome::not_converged);
  EXPECT_THAT(soft.reason, HasSubstr("is too soft in torsion for its spin"));
}

TEST(Doubts, AreTheLastLinesOfTheReport) {
  RunReport report;
  report.steps = 1;
  report.doubts = {"something"};
  EXPECT_THAT(report_text(report, {}), ::testing::EndsWith("warning          something\n"));
  EXPECT_THAT(report_json(report), HasSubstr("\"something\""));
}

}  // namespace
}  // namespace tisserand::mechanism::doubts_test

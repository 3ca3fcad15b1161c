// What runs doubt of themselves: each doubt provoked, and silent where the answer is right.
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mechanism/doubts/energy_balance.hpp"
#include "mechanism/doubts/linear_range.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
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

RunReport run(const formats::Scene& scene, const BodyFiles& files = {}) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.file("a.results.h5");
  return simulate(RunRequest{scene, files, std::nullopt, path, "", std::nullopt}, RunControl{}).report;
}

/// Rows of a run from 0 to 80 with kinetic energy 1 and the given balance.
template <class Balance>
std::vector<std::string> told_by(Balance balance) {
  EnergyBalance energy(0.0, 80.0);
  formats::ResultsRow row;
  row.kinetic = row.total = 1.0;
  for (int i = 0; i <= 80; ++i) {
    row.time = i;
    row.balance = balance(row.time);
    energy.observe(row);
  }
  return energy.doubts();
}

TEST(EnergyDoubt, SpeaksBeyondAHundredthOfWhatMoved) {
  EXPECT_THAT(told_by([](double t) { return t < 40 ? 0.0 : -0.02; }),
              ElementsAre(HasSubstr("0.02 of the energy that moved was lost")));
  EXPECT_THAT(told_by([](double t) { return 0.009 * std::sin(t); }), IsEmpty());
}

TEST(EnergyDoubt, SpeaksOfASteadyDrift) {
  EXPECT_THAT(told_by([](double t) { return 5e-5 * t; }), ElementsAre(HasSubstr("steadily gained")));
  EXPECT_THAT(told_by([](double t) { return 5e-6 * t; }), IsEmpty());  // 4e-4: far from the tolerance
  EXPECT_THAT(told_by([](double t) { return 4e-3 * (1.0 - std::exp(-t / 5.0)); }), IsEmpty());  // settles
}

TEST(StepDoubt, SpeaksWhereAPeriodHasFewSteps) {
  // A period of 2.3 s: 230 and 8 steps.
  const auto with_step = [](double step) {
    formats::Scene scene = test_support::pendulum_scene(step, 20.0);
    return run(scene).doubts;
  };
  EXPECT_THAT(with_step(0.01), IsEmpty());
  EXPECT_THAT(::testing::PrintToString(with_step(0.3)), HasSubstr("does not resolve what moves"));
}

TEST(MultiplierDoubt, SpeaksOfIndex3WithoutDamping) {
  formats::Scene scene = test_support::pendulum_scene(0.002, 5.0);
  scene.integrator.formulation = formats::Formulation::index3;
  scene.integrator.rho = 0.9;
  EXPECT_THAT(run(scene).doubts, IsEmpty());
  scene.integrator.rho = 1.0;
  const RunReport report = run(scene);
  EXPECT_THAT(::testing::PrintToString(report.doubts) + report.reason,
              HasSubstr("the multipliers swing from step to step"));
}

/// The beam as a superelement of four modes, held by a joint at its base.
struct HeldBeam {
  BeamData beam;
  BodyFiles files;
  formats::Scene scene = test_support::empty_scene(1e-3, 0.05);
  explicit HeldBeam(JointKind kind) {
    test_support::add_file("beam", test_support::craig_bampton_beam(beam, 4), files.superelements);
    scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
    scene.joints.push_back(
        test_support::joint("base", kind, "ground", "beam/base", Vector3d::Zero(), Vector3d::UnitZ()));
  }
  /// Of a cantilever bending about its weaker axis, 3.5160 √(EI/(m L³)).
  double cantilever() const {
    return 3.5160 * std::sqrt(beam.young * beam.Iy / (beam.density * beam.area * std::pow(beam.length, 4)));
  }
  /// Euler's load between pins.
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

/// The slider-crank of [GA00] 4.3 with its rod as one superelement, driven at a constant rate.
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

// Against exact beams the rod errs by 18.8 % with A and B, by 8.9 % with M (examples/inertia_options). That the doubt
// is silent of bodies that turn without translating shows SpinDoubt.
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
              ElementsAre(HasSubstr("damping of 'beam' does not reach its lowest mode")));
  body.damping = {};
  body.damping.ratio = 0.02;
  EXPECT_THAT(run(held.scene, held.files).doubts, IsEmpty());
}

/// A crank of 1 m that drives a slider through a rod of `rod`: shorter than the crank it locks at asin(rod).
RunReport run_of_crank(double rod, formats::IntegratorSpec integrator) {
  const Vector3d z = Vector3d::UnitZ();
  formats::Scene scene = test_support::empty_scene(integrator.step, 1.0);
  integrator.end = 1.0;
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
  EXPECT_THAT(locked.reason, HasSubstr("the drive leaves what the mechanism can reach"));
  EXPECT_THAT(locked.reason, HasSubstr("t = 0.5235"));  // asin(1/2)
  EXPECT_EQ(run_of_crank(1.1, integrator).outcome, RunOutcome::completed);
}

TEST(Doubts, AreTheLastLinesOfTheReport) {
  RunReport report;
  report.steps = 1;
  report.doubts = {"something"};
  EXPECT_THAT(report_text(report, {}), ::testing::EndsWith("in doubt         something\n"));
  EXPECT_THAT(report_json(report), HasSubstr("\"something\""));
}

}  // namespace
}  // namespace tisserand::mechanism::doubts_test

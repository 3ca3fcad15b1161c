// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that reach an error which was asked for: held against runs far finer, and against modes that are not there.
#include "mechanism/study/accuracy.hpp"

#include <cmath>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mechanism/histories/tables.hpp"
#include "mechanism/study/measure.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/scenes/andrews.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::mechanism::accuracy_test {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

formats::Scene with(formats::Scene scene, double error, const std::string& of) {
  scene.integrator.step = 1e-4 * scene.integrator.end;
  scene.integrator.error_control.active = true;
  scene.integrator.accuracy = {error, of, formats::ErrorNorm::max, std::nullopt};
  return scene;
}

struct Reached {
  RunReport report;
  double error = 0.0;  ///< of the channel against radau with a millionth of the error as tolerance, over its size
};

Reached reach(const formats::Scene& scene, const BodyFiles& files) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.file("a.results.h5"), fine = folder.file("b.results.h5");
  const RunRequest request{scene, files, std::nullopt, path, "", std::nullopt};
  Reached reached{simulate_to_accuracy(request, {}).report, 0.0};
  formats::Scene finer = scene;
  finer.integrator.accuracy.reset();
  finer.integrator.method = formats::Method::radau;
  finer.integrator.linear_solver = formats::LinearSolver::automatic;
  finer.integrator.error_control.tolerance = 1e-6 * scene.integrator.accuracy->error;
  finer.output.interval = (scene.integrator.end - scene.integrator.start) / 500;
  simulate({finer, files, std::nullopt, fine, "", std::nullopt}, {});
  formats::StudyQuantity quantity;
  const std::vector<std::string> channel{scene.integrator.accuracy->of};
  reached.error = error_of(read_quantities(path, channel).front(), read_quantities(fine, channel).front(), quantity);
  return reached;
}

// The pendulum loses digits where it turns slowly; Andrews' mechanism multiplies errors along its way.
TEST(Accuracy, IsReachedAndReported) {
  for (const double error : {1e-2, 1e-3}) {
    const Reached pendulum = reach(with(test_support::pendulum_scene(0.01, 2.0), error, "joints/coordinate/hinge"), {});
    EXPECT_LE(pendulum.error, error);
    EXPECT_GT(pendulum.error, 1e-3 * error);  // no work is wasted on what nobody asked for
    EXPECT_THAT(pendulum.report.doubts, IsEmpty());
    EXPECT_THAT(::testing::PrintToString(pendulum.report.notes),
                HasSubstr("accuracy: the error of 'joints/coordinate/hinge' is estimated at"));
    const formats::Scene andrews = test_support::andrews(1e-4);
    const std::string of = fmt::format("nodes/position/{}/x", std::get<formats::RigidBodySpec>(andrews.bodies[4]).name);
    EXPECT_LE(reach(with(andrews, error, of), {}).error, error);
  }
}

/// A cantilever that a sudden weight at its tip sets swinging; `modes` of its internal vibrations are in the file.
formats::Scene cantilever(int modes, BodyFiles& files) {
  test_support::add_file("beam", test_support::craig_bampton_beam({}, modes), files.superelements);
  formats::Scene scene = test_support::empty_scene(1e-3, 0.03);
  scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
  scene.joints.push_back(test_support::joint("base", formats::JointKind::fixed, "ground", "beam/base", Vector3d::Zero(),
                                             Vector3d::UnitZ()));
  scene.loads.push_back(
      test_support::constant_load("weight", formats::LoadKind::force, "beam/tip", Vector3d(0, 0, -100)));
  return scene;
}

TEST(Accuracy, LeavesOutModesThatNothingFeels) {
  BodyFiles files;
  const Reached swing = reach(with(cantilever(18, files), 0.05, "nodes/position/beam/tip/z"), files);
  EXPECT_LE(swing.error, 0.05);  // the reference has all modes
  EXPECT_THAT(::testing::PrintToString(swing.report.notes), HasSubstr("modes: 9 of 'beam', the others change"));
  EXPECT_THAT(swing.report.doubts, IsEmpty());
}

// The first run with half of the modes differs by little from the second with all: no third one tells both apart.
TEST(Accuracy, AsksForModesAndToleranceAtOnce) {
  BodyFiles files;
  formats::Scene scene = with(cantilever(18, files), 0.1, "nodes/position/beam/tip/z");
  scene.integrator.method = formats::Method::automatic;
  const Reached swing = reach(scene, files);
  EXPECT_LE(swing.error, 0.1);
  EXPECT_THAT(::testing::PrintToString(swing.report.notes),
              HasSubstr("half of the modes and the previous tolerance together change it by"));
}

// Steps that end on instants of output are the same with every coarse tolerance, and differ by nothing.
TEST(Accuracy, IsNotTakenFromRunsOfTheSameSteps) {
  formats::Scene scene = with(test_support::pendulum_scene(0.01, 1.0), 1e-2, "joints/coordinate/hinge");
  scene.output.interval = 2e-3;
  const Reached swing = reach(scene, {});
  EXPECT_LE(swing.error, 1e-2);
  EXPECT_EQ(::testing::PrintToString(swing.report.notes).find("estimated at 0 "), std::string::npos);
}

// Two modes in each plane, of which half leaves one: the higher ones move as fast as the lower ones.
TEST(Accuracy, DoubtsWhatAFileDoesNotHold) {
  BodyFiles files;
  const Reached swing = reach(with(cantilever(4, files), 1e-4, "nodes/velocity/beam/tip/z"), files);
  EXPECT_THAT(::testing::PrintToString(swing.report.doubts),
              HasSubstr("may need modes that the superelement files do not contain"));
}

// Nothing in the pendulum vibrates: `radau` takes some hundred steps where generalised alpha takes ten thousands.
TEST(Accuracy, ChoosesTheMethodThatIsNotNamed) {
  formats::Scene scene = with(test_support::pendulum_scene(0.01, 4.0), 1e-5, "joints/coordinate/hinge");
  scene.integrator.method = formats::Method::automatic;
  const Reached swing = reach(scene, {});
  EXPECT_LE(swing.error, 1e-5);
  EXPECT_LT(swing.report.steps, 1000);
  EXPECT_THAT(::testing::PrintToString(swing.report.notes), HasSubstr("of radau"));
  scene.integrator.linear_solver = formats::LinearSolver::qr;  // has no complex values
  scene.integrator.accuracy->error = 1e-3;
  const Reached other = reach(scene, {});
  EXPECT_LE(other.error, 1e-3);
  EXPECT_THAT(::testing::PrintToString(other.report.notes), HasSubstr("of generalised_alpha"));
}

// Undamped vibrations that a sudden load kicks, by a clock on which runs take the cube of their steps.
TEST(Accuracy, BeginsNoRunThatWouldTakeTooLong) {
  const test_support::TemporaryFolder folder;
  BodyFiles files;
  formats::Scene scene = with(cantilever(4, files), 1e-4, "nodes/velocity/beam/tip/z");
  scene.output.interval = scene.integrator.end / 20.0;
  double steps = 0.0;
  const RunControl control{{}, [&](double) { ++steps; }, [&] { return std::pow(steps, 3); }};
  const std::string path = folder.file("a.results.h5");
  const RunReport report = simulate_to_accuracy({scene, files, std::nullopt, path, "", std::nullopt}, control).report;
  EXPECT_EQ(report.outcome, RunOutcome::completed);
  EXPECT_GT(3 * report.steps, steps);  // the first, and two with half and all of the modes
  EXPECT_THAT(::testing::PrintToString(report.doubts),
              AllOf(HasSubstr("the error 0.0001 of 'nodes/velocity/beam/tip/z' was not reached"),
                    HasSubstr("the next run would take about"), HasSubstr("or use method: radau"),
                    HasSubstr("error_control: {tolerance: ")));
  const std::vector<std::string> channel{scene.integrator.accuracy->of};
  EXPECT_EQ(read_quantities(path, channel).front().x.size(), 21u);                      // the best result so far
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);  // nothing of the runs before
}

// The end of a beam is stored under one name and found by both.
TEST(Accuracy, FindsANodeByItsOtherName) {
  formats::Scene scene = test_support::empty_scene(1e-3, 0.05);
  formats::BeamBodySpec beam;
  beam.name = "beam";
  beam.to = {1.0, 0.0, 0.0};
  beam.elements = 2;
  beam.section = {"square", 1e-4, 1e-9, 1e-9, 2e-9, 2e-9, 8e-5, 8e-5, ""};
  beam.material = {"steel", 2e11, 0.3, 7800.0, ""};
  scene.bodies.push_back(beam);
  scene.gravity = {0.0, 0.0, -9.81};
  scene.joints.push_back(test_support::joint("hinge", formats::JointKind::revolute, "ground", "beam/start",
                                             Vector3d::Zero(), Vector3d::UnitY()));
  EXPECT_LE(reach(with(scene, 1e-2, "nodes/position/beam/end/z"), {}).error, 1e-2);
}

TEST(Accuracy, RefusesWhatItCannotMeasure) {
  const test_support::TemporaryFolder folder;
  const auto thrown = [&](const std::string& of) {
    const formats::Scene scene = with(test_support::pendulum_scene(0.01, 1.0), 1e-3, of);
    return test_support::error_of([&] {
      simulate_to_accuracy({scene, {}, std::nullopt, folder.file("a.results.h5"), "", std::nullopt}, {});
    });
  };
  EXPECT_THAT(thrown("joints/coordinate/hing"), HasSubstr("joints/coordinate/hinge"));
  EXPECT_THAT(thrown("nodes/position/pendulum/z"), HasSubstr("scale"));  // it stays zero
}

}  // namespace
}  // namespace tisserand::mechanism::accuracy_test

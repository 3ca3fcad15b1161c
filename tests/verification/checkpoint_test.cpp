// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints: a run that goes on from one is bit-equal to a run that was never interrupted; from results to the
// tolerance; bad files are refused.
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "mechanism/run/checkpoint.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::checkpoint_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::joint;
using test_support::TemporaryFolder;
using ::testing::HasSubstr;

const Vector3d y = Vector3d::UnitY();

/// Superelement with damping on a hinge, a rigid bob on its tip, a spring with a moment over time: all that has memory.
formats::Scene swing() {
  formats::Scene scene = test_support::empty_scene(0.004, 0.4);
  scene.gravity = {0, 0, -9.81};
  formats::SuperelementBodySpec beam = test_support::superelement_body("beam", "beam");
  beam.damping.ratio = 0.01;
  beam.frame = formats::FrameKind::paper;
  scene.bodies.push_back(beam);
  formats::RigidBodySpec bob = test_support::rigid_body("bob", 3.0, {0.1, 0, 0}, {0.02, 0.02, 0.02});
  bob.start.pose.position = {2, 0, 0};
  scene.bodies.push_back(bob);
  scene.joints.push_back(joint("hinge", JointKind::revolute, "ground", "beam/base", Vector3d::Zero(), y));
  scene.joints.push_back(joint("bob", JointKind::spherical, "beam/tip", "bob", {2, 0, 0}, y));
  formats::SpringSpec motor;
  motor.name = "motor";
  motor.coordinate = formats::CoordinateRef{"hinge", ""};
  motor.damping = 0.5;
  motor.force = formats::TimeTable{{0.0, 0.15, 0.3}, {0.0, 40.0, -20.0}};
  scene.springs.push_back(motor);
  return scene;
}

/// Nonlinear beam, driven about a hinge.
formats::Scene whip() {
  formats::Scene scene = test_support::empty_scene(0.005, 0.3);
  scene.integrator.formulation = formats::Formulation::index3;
  formats::BeamBodySpec beam;
  beam.name = "whip";
  beam.to = {1, 0, 0};
  beam.elements = 4;
  beam.section.area = 1e-4;
  beam.section.second_moment_y = beam.section.second_moment_z = 1e-9;
  beam.section.polar_moment = 2e-9;
  beam.section.torsion_constant = 1.7e-9;
  beam.section.shear_area_y = beam.section.shear_area_z = 8e-5;
  beam.material.youngs_modulus = 2e10;
  beam.material.poisson_ratio = 0.3;
  beam.material.density = 2000.0;
  scene.bodies.push_back(beam);
  scene.joints.push_back(joint("hinge", JointKind::revolute, "ground", "whip/start", Vector3d::Zero(), y));
  scene.motions.push_back(test_support::drive("hinge", "3 * t^2"));
  return scene;
}

/// A parallelogram of hinges: overconstrained.
formats::Scene parallelogram() {
  formats::Scene scene = test_support::empty_scene(0.005, 0.5);
  scene.gravity = {0, 0, -9.81};
  const auto link = [&scene](const std::string& name, const Vector3d& at, const Vector3d& center) {
    formats::RigidBodySpec body = test_support::rigid_body(name, 1.0, center, {0.1, 0.1, 0.1});
    body.start.pose.position = at;
    scene.bodies.push_back(body);
  };
  link("left", {0, 0, 0}, {0.2, 0, -0.4});
  link("right", {1, 0, 0}, {0.2, 0, -0.4});
  link("floor", {0.4, 0, -0.8}, {0.5, 0, 0});
  scene.joints.push_back(joint("a", JointKind::revolute, "ground", "left", {0, 0, 0}, y));
  scene.joints.push_back(joint("b", JointKind::revolute, "ground", "right", {1, 0, 0}, y));
  scene.joints.push_back(joint("c", JointKind::revolute, "left", "floor", {0.4, 0, -0.8}, y));
  scene.joints.push_back(joint("d", JointKind::revolute, "right", "floor", {1.4, 0, -0.8}, y));
  return scene;
}

/// A soft rod with lumped masses that falls about a hinge, with a bob on its end: the modal coordinates swing by a
/// tenth of its length.
formats::Scene soft_rod() {
  formats::Scene scene = test_support::empty_scene(0.004, 0.4);
  scene.gravity = {0, 0, -9.81};
  formats::ModalBodySpec rod;
  rod.name = "rod";
  rod.file = "rod";
  rod.damping.ratio = 0.02;
  rod.start.angular_velocity = {0, 1, 0};
  scene.bodies.push_back(rod);
  formats::RigidBodySpec bob = test_support::rigid_body("bob", 0.1, {0.1, 0, 0}, {0.002, 0.002, 0.002});
  bob.start.pose.position = {1, 0, 0};
  bob.start.velocity = {0, 0, -1};
  bob.start.angular_velocity = {0, 1, 0};
  scene.bodies.push_back(bob);
  scene.joints.push_back(joint("hinge", JointKind::revolute, "ground", "rod/n0", Vector3d::Zero(), y));
  scene.joints.push_back(joint("bob", JointKind::spherical, "rod/n4", "bob", {1, 0, 0}, y));
  return scene;
}

/// A second-order superelement that turns about a hinge, bent by its weight.
formats::Scene blade() {
  formats::Scene scene = test_support::empty_scene(0.004, 0.4);
  scene.gravity = {0, 0, -9.81};
  formats::SuperelementBodySpec body = test_support::superelement_body("blade", "blade");
  body.start.angular_velocity = {0, 0, 2};
  body.damping.stiffness = 1e-4;
  scene.bodies.push_back(body);
  scene.joints.push_back(
      joint("hinge", JointKind::revolute, "ground", "blade/n0", Vector3d::Zero(), Vector3d::UnitZ()));
  return scene;
}

formats::Scene in_its_plane(formats::Scene scene) {
  scene.effects.push_back({formats::Effect::planar, "", true, "switch"});
  return scene;
}
formats::Scene planar_swing() { return in_its_plane(swing()); }
formats::Scene planar_soft_rod() { return in_its_plane(soft_rod()); }
formats::Scene planar_blade() {
  formats::Scene scene = blade();
  scene.gravity = {0, -9.81, 0};
  return in_its_plane(scene);
}

/// Adds the files of `blade`: the superelement and its companion, with the identifier of its contents.
void add_blade(BodyFiles& list) {
  const test_support::SectionData section = test_support::slender_section(1e5);
  const test_support::SecondOrderBody made =
      test_support::second_order_beam(test_support::bernoulli_beam(section, 2.0, 8), {0, 8}, 4);
  test_support::add_file("blade", made.element, list.superelements);
  list.companions["blade"] = made.companion;
  list.companions["blade"].companion_id = formats::companion_id(made.companion);
}

BodyFiles files() {
  BodyFiles list;
  add_blade(list);
  test_support::add_file("beam", test_support::craig_bampton_beam({}, 3), list.superelements);
  const test_support::Rod rod{0.0, 1.0, 1e-3, 1e6, 4e5, 1e-7, 2000.0, 4};
  list.modal_bodies["rod"].body = test_support::modal_body(test_support::lumped_rod(rod), {}, 4);
  return list;
}

RunRequest request(const formats::Scene& scene, const BodyFiles& list, const std::string& path) {
  return {scene, list, std::nullopt, path, "", std::nullopt};
}

struct Case {
  const char* name;
  formats::Scene (*scene)();
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class Checkpoint : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Checkpoint,
                         ::testing::Values(Case{"swing", swing}, Case{"whip", whip},
                                           Case{"parallelogram", parallelogram}, Case{"soft_rod", soft_rod},
                                           Case{"blade", blade}, Case{"planar_swing", planar_swing},
                                           Case{"planar_soft_rod", planar_soft_rod},
                                           Case{"planar_blade", planar_blade}),
                         [](const ::testing::TestParamInfo<Case>& given) { return given.param.name; });

// The first run goes through a second checkpoint, which both runs pass alike; the file kept is that of the first.
TEST_P(Checkpoint, GoesOnBitEqual) {
  TemporaryFolder folder;
  const BodyFiles list = files();
  formats::Scene scene = GetParam().scene();
  scene.checkpoint.every = 30;
  const std::string kept = folder.file("kept.h5");
  RunControl control;
  control.progress = [&](double) {
    const std::string written = folder.file("a.checkpoint.h5");
    if (std::filesystem::exists(written) && !std::filesystem::exists(kept)) std::filesystem::copy_file(written, kept);
  };
  const RunEnd whole = simulate(request(scene, list, folder.file("a.results.h5")), control);
  RunRequest again = request(scene, list, folder.file("b.results.h5"));
  again.restart = kept;
  const RunEnd rest = simulate(again, {});
  EXPECT_EQ(whole.report.outcome, RunOutcome::completed) << whole.report.reason;
  EXPECT_EQ(rest.report.steps, whole.report.steps - 30);
  EXPECT_EQ(rest.state.block(), whole.state.block());
  // The equality is not that of two models at rest.
  EXPECT_GT(rest.state.v().norm(), 0.0);
}

TEST_P(Checkpoint, GoesOnFromAStoredInstantToTheTolerance) {
  TemporaryFolder folder;
  const BodyFiles list = files();
  const formats::Scene scene = GetParam().scene();
  const RunEnd whole = simulate(request(scene, list, folder.file("a.results.h5")), {});
  RunRequest again = request(scene, list, folder.file("b.results.h5"));
  again.restart = folder.file("a.results.h5");
  again.at = 0.2;
  const RunEnd rest = simulate(again, {});
  // The algorithmic acceleration is computed again. It differs by O(h²), as at the start of any run.
  EXPECT_LT((rest.state.x() - whole.state.x()).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_NEAR(rest.state.time(), whole.state.time(), 1e-12);
  EXPECT_LT((rest.state.hinges() - whole.state.hinges()).cwiseAbs().sum(), 1e-2);
  if (whole.state.w().size() == 0) return;
  EXPECT_GT(whole.state.w().norm(), 1e-2);
  EXPECT_LT((rest.state.w() - whole.state.w()).norm(), 1e-3 * whole.state.w().norm());
}

std::string refusal(const formats::Scene& scene, const std::string& file, const std::string& results,
                    const BodyFiles& list = files()) {
  RunRequest again = request(scene, list, results);
  again.restart = file;
  try {
    static_cast<void>(simulate(again, {}));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// A planar model has no coordinates for the spatial motion that a run in space has stored.
TEST(CheckpointFile, AStoredInstantOutOfThePlaneIsRefused) {
  TemporaryFolder folder;
  formats::Scene bent = soft_rod();
  bent.gravity.y() = 1.0;
  static_cast<void>(simulate(request(bent, files(), folder.file("bent.results.h5")), {}));
  static_cast<void>(simulate(request(soft_rod(), files(), folder.file("flat.results.h5")), {}));
  formats::Scene planar = planar_soft_rod();
  planar.integrator.end = 0.5;
  EXPECT_THAT(refusal(planar, folder.file("bent.results.h5"), folder.file("b.results.h5")),
              HasSubstr("out of the plane of the scene"));
  EXPECT_EQ(refusal(planar, folder.file("flat.results.h5"), folder.file("c.results.h5")), "");
}

/// A beam held at both ends: its boundary rests, its internal modes vibrate.
formats::Scene held_beam(const Vector3d& gravity) {
  formats::Scene scene = test_support::empty_scene(0.001, 0.05);
  scene.gravity = gravity;
  scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
  scene.joints.push_back(joint("base", JointKind::fixed, "ground", "beam/base", Vector3d::Zero(), y));
  scene.joints.push_back(joint("tip", JointKind::fixed, "ground", "beam/tip", {2, 0, 0}, y));
  return scene;
}

TEST(CheckpointFile, AStoredModeOutOfThePlaneIsRefusedWhereAllNodesRest) {
  TemporaryFolder folder;
  static_cast<void>(simulate(request(held_beam({0, -9.81, -5}), files(), folder.file("bent.results.h5")), {}));
  static_cast<void>(simulate(request(held_beam({0, -9.81, 0}), files(), folder.file("flat.results.h5")), {}));
  formats::Scene planar = in_its_plane(held_beam({0, -9.81, 0}));
  planar.integrator.end = 0.1;
  EXPECT_THAT(refusal(planar, folder.file("bent.results.h5"), folder.file("b.results.h5")),
              AllOf(HasSubstr("out of the plane of the scene"), HasSubstr("'beam'")));
  EXPECT_EQ(refusal(planar, folder.file("flat.results.h5"), folder.file("c.results.h5")), "");
}

// The only motion is out of the plane, but so slow that it is round-off of rest.
TEST(CheckpointFile, RoundOffOfRestIsNoMotionOutOfThePlane) {
  TemporaryFolder folder;
  const auto drifting = [](double velocity) {
    formats::Scene scene = test_support::empty_scene(0.01, 0.1);
    formats::RigidBodySpec body = test_support::rigid_body("body", 1.0, Vector3d::Zero(), {0.1, 0.1, 0.1});
    body.start.velocity = {0, 0, velocity};
    scene.bodies.push_back(body);
    return scene;
  };
  static_cast<void>(simulate(request(drifting(1e-14), {}, folder.file("rest.results.h5")), {}));
  static_cast<void>(simulate(request(drifting(1e-6), {}, folder.file("slow.results.h5")), {}));
  formats::Scene planar = in_its_plane(drifting(0.0));
  planar.integrator.end = 0.2;
  EXPECT_EQ(refusal(planar, folder.file("rest.results.h5"), folder.file("b.results.h5"), {}), "");
  EXPECT_THAT(refusal(planar, folder.file("slow.results.h5"), folder.file("c.results.h5"), {}),
              HasSubstr("the velocity of 'body'"));
}

TEST(CheckpointFile, IsRefusedIfItIsNotOfThisSceneOrNotWhole) {
  TemporaryFolder folder;
  const BodyFiles list = files();
  formats::Scene scene = parallelogram();
  scene.checkpoint.interval = 0.1;
  static_cast<void>(simulate(request(scene, list, folder.file("a.results.h5")), {}));
  const std::string file = folder.file("a.checkpoint.h5"), out = folder.file("b.results.h5");
  EXPECT_THAT(refusal(scene, file, out), HasSubstr("increase integrator.end"));  // its last instant is the end
  scene.integrator.end = 1.0;
  EXPECT_EQ(refusal(scene, file, out), "");
  EXPECT_THAT(refusal(swing(), file, out), HasSubstr("whose bodies, joints, superelements or companion files differ"));
  formats::Scene renamed = scene;
  renamed.joints[0].name = "other";
  EXPECT_THAT(refusal(renamed, file, out), HasSubstr("whose bodies, joints, superelements or companion files differ"));
  EXPECT_THAT(refusal(scene, folder.file("none.h5"), out), HasSubstr("none.h5"));
  const auto size = std::filesystem::file_size(file);
  std::filesystem::copy_file(file, folder.file("short.h5"));
  std::filesystem::resize_file(folder.file("short.h5"), size - 100);
  EXPECT_NE(refusal(scene, folder.file("short.h5"), out), "");
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const double time = 0.5;  // one number of the state changed: the instant
  const std::string pattern(reinterpret_cast<const char*>(&time), sizeof time);
  const std::size_t at = bytes.rfind(pattern);
  ASSERT_NE(at, std::string::npos);
  bytes[at] ^= 1;
  std::ofstream(folder.file("bent.h5"), std::ios::binary) << bytes;
  EXPECT_THAT(refusal(scene, folder.file("bent.h5"), out), HasSubstr("damaged"));
}

TEST(CheckpointFile, IsRefusedWithoutTheCompanionThatItWasWrittenWithAndWithAnother) {
  TemporaryFolder folder;
  formats::Scene scene = blade();
  scene.checkpoint.interval = 0.1;
  static_cast<void>(simulate(request(scene, files(), folder.file("a.results.h5")), {}));
  const std::string file = folder.file("a.checkpoint.h5"), out = folder.file("b.results.h5");
  scene.integrator.end = 1.0;
  EXPECT_EQ(refusal(scene, file, out), "");
  BodyFiles without = files(), other = files();
  without.companions.clear();
  EXPECT_THAT(refusal(scene, file, out, without),
              HasSubstr("whose bodies, joints, superelements or companion files differ"));
  formats::Companion& companion = other.companions.at("blade");
  companion.E[0] *= 1.0 + 1e-9;
  companion.companion_id = formats::companion_id(companion);
  EXPECT_THAT(refusal(scene, file, out, other),
              HasSubstr("whose bodies, joints, superelements or companion files differ"));
}

/// All channels of a file without conversion, one row per instant.
Eigen::MatrixXd contents(const std::string& path) {
  const formats::ResultsReader reader(path);
  std::vector<std::string> names;
  for (const formats::Channel& channel : reader.channels()) names.push_back(channel.name);
  return reader.read_rows(names, 0, reader.rows());
}

bool is_bit_equal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

/// Runs in a child process that SIGKILL ends at the first accepted step for which `when` holds.
void die_in_run(const RunRequest& run, const std::function<bool(double)>& when) {
  const pid_t child = ::fork();
  if (child == 0) {
    RunControl control;
    control.progress = [&when](double time) {
      if (when(time)) ::raise(SIGKILL);
    };
    static_cast<void>(simulate(run, control));
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the run ended by itself";
}

/// Scene with rows between checkpoints too. The death of the run loses some of them.
formats::Scene scene_with_checkpoints(formats::Scene (*make)()) {
  formats::Scene scene = make();
  scene.checkpoint.every = 20;
  scene.output.every = 3;
  return scene;
}

TEST_P(Checkpoint, RowsUntilThenAreOnTheDisk) {
  TemporaryFolder folder;
  const BodyFiles list = files();
  const formats::Scene scene = scene_with_checkpoints(GetParam().scene);
  const std::string file = folder.file("a.checkpoint.h5");
  die_in_run(request(scene, list, folder.file("a.results.h5")), [&](double) { return std::filesystem::exists(file); });
  const formats::Checkpoint checkpoint = formats::read_checkpoint(file);
  const formats::ResultsReader reader(folder.file("a.results.h5"));
  EXPECT_EQ(checkpoint.rows, 7u);  // of the start and of steps 3, 6, ... 18
  EXPECT_GE(reader.rows(), checkpoint.rows);
  EXPECT_EQ(checkpoint.run, reader.run());
  EXPECT_EQ(checkpoint.results, "a.results.h5");
}

TEST_P(Checkpoint, AppendedRunIsBitEqualToOneThatWasNeverInterrupted) {
  TemporaryFolder folder;
  const BodyFiles list = files();
  const formats::Scene scene = scene_with_checkpoints(GetParam().scene);
  const double h = scene.integrator.step;
  static_cast<void>(simulate(request(scene, list, folder.file("whole.results.h5")), {}));
  const Eigen::MatrixXd whole = contents(folder.file("whole.results.h5"));
  const std::string results = folder.file("a.results.h5");
  RunRequest again = request(scene, list, results);
  again.restart = folder.file("a.checkpoint.h5");
  again.joining = Joining::appended;
  // Killed after steps 28, 34 (restarted at 20, before the next checkpoint) and 47 (restarted at 20, after that of 40).
  die_in_run(request(scene, list, results), [h](double t) { return t > 27.5 * h; });
  die_in_run(again, [h](double t) { return t > 33.5 * h; });
  EXPECT_TRUE(std::filesystem::exists(results));  // the rows of the first run, unchanged
  die_in_run(again, [h](double t) { return t > 46.5 * h; });
  const RunReport report = simulate(again, {}).report;
  EXPECT_EQ(report.outcome, RunOutcome::completed) << report.reason;
  EXPECT_EQ(report.rows, whole.rows());
  EXPECT_TRUE(is_bit_equal(contents(results), whole));
  EXPECT_FALSE(std::filesystem::exists(results + ".part"));
}

TEST(CheckpointFile, AppendsToAnInterruptedRunAndToAStoredInstant) {
  TemporaryFolder folder;
  const BodyFiles list = files();
  const formats::Scene scene = scene_with_checkpoints(swing);
  static_cast<void>(simulate(request(scene, list, folder.file("whole.results.h5")), {}));
  const Eigen::MatrixXd whole = contents(folder.file("whole.results.h5"));
  const std::string results = folder.file("a.results.h5");
  int polls = 0;
  RunControl control;
  control.interrupted = [&polls] { return ++polls > 20; };  // at a checkpoint, at whose instant no row was due
  static_cast<void>(simulate(request(scene, list, results), control));
  RunRequest again = request(scene, list, folder.file("joined.results.h5"));
  again.restart = folder.file("a.checkpoint.h5");
  again.joining = Joining::appended;
  const RunReport report = simulate(again, {}).report;
  EXPECT_TRUE(is_bit_equal(contents(folder.file("joined.results.h5")), whole));
  EXPECT_THAT(report_json(report), HasSubstr("interrupted at t ="));  // messages of the first part are kept
  EXPECT_EQ(contents(results).rows(), 8);
  // From a stored instant: its row appears once, later rows are computed again and agree to the tolerance.
  again.restart = folder.file("whole.results.h5");
  again.at = whole(30, 0);
  static_cast<void>(simulate(again, {}));
  const Eigen::MatrixXd rest = contents(folder.file("joined.results.h5"));
  ASSERT_EQ(rest.rows(), whole.rows());
  EXPECT_TRUE(is_bit_equal(rest.topRows(31), whole.topRows(31)));
  EXPECT_LT((rest.col(0) - whole.col(0)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CheckpointFile, AppendsOnlyToTheRunThatWroteIt) {
  TemporaryFolder folder;
  const BodyFiles list = files();
  const formats::Scene scene = scene_with_checkpoints(swing);
  const std::string results = folder.file("a.results.h5");
  RunControl control;
  control.interrupted = [polls = 0]() mutable { return ++polls > 30; };
  static_cast<void>(simulate(request(scene, list, results), control));
  formats::Scene other = scene;
  other.checkpoint = {};
  static_cast<void>(simulate(request(other, list, results), {}));  // replaces the rows, not the checkpoint
  RunRequest again = request(scene, list, results);
  again.restart = folder.file("a.checkpoint.h5");
  again.joining = Joining::appended;
  try {
    static_cast<void>(simulate(again, {}));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no longer exist"));
  }
}

}  // namespace
}  // namespace tisserand::mechanism::checkpoint_test

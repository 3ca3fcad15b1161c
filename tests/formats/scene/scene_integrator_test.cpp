// SPDX-License-Identifier: GPL-3.0-or-later
// `integrator` of scene.yaml: error control, bdf, linear solvers; keys that have no effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::scene_integrator_test {
namespace {

using ::testing::HasSubstr;

std::string scene_with(const std::string& integrator) {
  return "scene: fall\ngravity: [0, 0, -9.81]\nbodies: {stone: {type: rigid, mass: 1, inertia: [1, 1, 1]}}\n"
         "integrator: {" +
         integrator + "}\n";
}

IntegratorSpec read(const std::string& integrator) {
  const Folder folder;
  return read_scene(folder.file("scene.yaml", scene_with(integrator)), {}).integrator;
}

std::string error(const std::string& integrator) {
  const Folder folder;
  const std::string path = folder.file("scene.yaml", scene_with(integrator));
  return error_of(folder, [&] { read_scene(path, {}); });
}

TEST(ErrorControl, IsReadWithItsLimits) {
  EXPECT_FALSE(read("step: 0.1, end: 1").error_control.active);
  const IntegratorSpec all = read("step: 0.1, end: 1, error_control: {tolerance: 1e-5, min_step: 1e-7, max_step: 0.2}");
  EXPECT_TRUE(all.error_control.active);
  EXPECT_EQ(all.error_control.tolerance, 1e-5);
  EXPECT_EQ(all.error_control.min_step, 1e-7);
  EXPECT_EQ(all.error_control.max_step, 0.2);
  EXPECT_DOUBLE_EQ(read("step: auto, start: 1, end: 3, error_control: {tolerance: 1e-5}").step, 2e-4);
  EXPECT_DOUBLE_EQ(read("step: auto, end: 2, error_control: {max_step: 1e-5}").step, 1e-5);
}

TEST(Integrator, AccuracyTakesThePlaceOfStepAndErrorControl) {
  const IntegratorSpec spec = read("end: 2, accuracy: {error: 1e-3, of: nodes/position/arm/x, norm: rms, scale: 2}");
  ASSERT_TRUE(spec.accuracy);
  EXPECT_EQ(spec.accuracy->error, 1e-3);
  EXPECT_EQ(spec.accuracy->of, "nodes/position/arm/x");
  EXPECT_EQ(spec.accuracy->norm, ErrorNorm::rms);
  EXPECT_EQ(spec.accuracy->scale, 2.0);
  EXPECT_TRUE(spec.error_control.active);
  EXPECT_GT(spec.step, 0.0);
  EXPECT_FALSE(read("method: bdf, end: 2, accuracy: {error: 1e-3, of: energy/total}").error_control.active);
  EXPECT_EQ(spec.method, Method::automatic);
  const auto method_of = [](const std::string& keys) {
    return read(keys + ", end: 2, accuracy: {error: 1e-3, of: a}").method;
  };
  EXPECT_EQ(method_of("method: auto"), Method::automatic);
  EXPECT_EQ(method_of("method: generalised_alpha"), Method::generalised_alpha);
  EXPECT_EQ(method_of("rho: 0.8"), Method::generalised_alpha);
  EXPECT_EQ(method_of("formulation: index3"), Method::generalised_alpha);
  EXPECT_THAT(error("end: 2, step: 0.1, method: auto"),
              HasSubstr("method: auto needs 'accuracy' to choose the method"));
  EXPECT_THAT(error("end: 2, step: 0.1, accuracy: {error: 1e-3, of: a}"), HasSubstr("'step' is chosen by 'accuracy'"));
  EXPECT_THAT(error("end: 2, error_control: {tolerance: 1e-3}, accuracy: {error: 1e-3, of: a}"),
              HasSubstr("'error_control' is chosen by 'accuracy'"));
  EXPECT_THAT(error("end: 2, accuracy: {error: 1e-3}"), HasSubstr("'of'"));
  const Folder folder;  // statics before it shares the group
  const std::string both = scene_with("end: 2, accuracy: {error: 1e-3, of: a}") +
                           "analyses: {stand: {type: statics}, go: {type: dynamics, from: stand}}\n";
  EXPECT_NO_THROW(read_scene(folder.file("both.yaml", both), {}));
  EXPECT_THAT(error("end: 2, accuracy: {error: 2, of: a}"), HasSubstr("accuracy.error 2 must be at most 0.5"));
}

TEST(BdfSettings, AreRead) {
  const IntegratorSpec spec = read("method: bdf, end: 2, relative_tolerance: 1e-7, absolute_tolerance: 1e-9");
  EXPECT_EQ(spec.method, Method::bdf);
  EXPECT_EQ(spec.bdf.relative_tolerance, 1e-7);
  EXPECT_EQ(spec.bdf.absolute_tolerance, 1e-9);
  EXPECT_DOUBLE_EQ(spec.step, 2e-4);
  EXPECT_EQ(read("method: bdf, end: 2, step: 1e-5").step, 1e-5);
}

TEST(LinearSolvers, HaveTheirWords) {
  EXPECT_EQ(read("step: 0.1, end: 1, linear_solver: umfpack").linear_solver, LinearSolver::umfpack);
  EXPECT_EQ(read("step: 0.1, end: 1, linear_solver: qr").linear_solver, LinearSolver::qr);
}

TEST(IntegratorErrors, NameTheKeyAndTheRemedy) {
  EXPECT_THAT(error("step: auto, end: 1"),
              HasSubstr("scene.yaml:4:20: integrator: step: auto needs error_control or method: bdf"));
  EXPECT_THAT(error("step: 0.1, end: 1, relative_tolerance: 1e-7"), HasSubstr("'relative_tolerance' has no effect"));
  EXPECT_THAT(error("method: bdf, end: 1, rho: 0.5"), HasSubstr("'rho' has no effect"));
  EXPECT_THAT(error("method: bdf, end: 1, error_control: {tolerance: 1e-3}"),
              HasSubstr("'error_control' has no effect"));
  EXPECT_THAT(error("method: bdf, end: 1, stabilisation: baumgarte"),
              HasSubstr("unknown key 'stabilisation'; remove it: bdf projects onto the constraints"));
  EXPECT_THAT(error("step: 0.1, end: 1, error_control: {tolerance: 0}"), HasSubstr("tolerance 0 must be positive"));
  EXPECT_THAT(error("step: 0.1, end: 1, error_control: {min_step: -1}"), HasSubstr("must not be negative"));
  EXPECT_THAT(error("step: 0.1, end: 1, error_control: {min_step: 2, max_step: 1}"),
              HasSubstr("smaller than min_step"));
  EXPECT_THAT(error("method: bdf, end: 1, relative_tolerance: 0"), HasSubstr("relative_tolerance 0 must be positive"));
}

}  // namespace
}  // namespace tisserand::formats::scene_integrator_test

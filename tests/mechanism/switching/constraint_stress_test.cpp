// Bodies that reactions can stress though no load acts, and the load that a body keeps where its stiffening switches.
#include "mechanism/switching/constraint_stress.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mechanism/build/effects.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/run/run.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/switching/switch_model.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"

namespace tisserand::mechanism::constraint_stress_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::Simulation;
using ::testing::ElementsAre;

const Vector3d z = Vector3d::UnitZ();

/// Beams of 2 m along the sides of a square, "left" up from the origin, "top", and "right" down again, hinged to one
/// another and to ground; and "arm" on a hinge in the corner.
formats::Scene square(JointKind third, JointKind fourth, const Vector3d& axis) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  const auto add = [&](const std::string& name, const Vector3d& place, double angle) {
    formats::SuperelementBodySpec beam = test_support::superelement_body(name, "beam");
    beam.start.pose.position = place;
    beam.start.pose.orientation = Eigen::AngleAxisd(angle, z).toRotationMatrix();
    scene.bodies.emplace_back(beam);
  };
  add("left", {0, 0, 0}, 0.5 * M_PI);
  add("top", {0, 2, 0}, 0.0);
  add("right", {2, 2, 0}, -0.5 * M_PI);
  add("arm", {2, 2, 0}, 0.0);
  scene.joints = {test_support::joint("A", JointKind::revolute, "ground", "left/base", {0, 0, 0}, z),
                  test_support::joint("B", JointKind::revolute, "left/tip", "top/base", {0, 2, 0}, z),
                  test_support::joint("C", third, "top/tip", "right/base", {2, 2, 0}, axis),
                  test_support::joint("D", fourth, "ground", "right/tip", {2, 0, 0}, z),
                  test_support::joint("E", JointKind::revolute, "right/base", "arm/base", {2, 2, 0}, z)};
  return scene;
}

std::vector<bool> stressed(const formats::Scene& scene, const BodyFiles& files) {
  Simulation run(scene, files);
  Evaluation now(run.model());
  evaluate(run.model(), run.state(), now);
  return stressed_by_constraints(run.model(), now);
}

BodyFiles beam_files() {
  BodyFiles files;
  test_support::add_file("beam", test_support::craig_bampton_beam({}, 3), files.superelements);
  return files;
}

// Four hinges have 20 rows on three bars of 18 freedoms, one of which moves; a spherical and a cylindrical joint in
// place of two of them have 3 fewer. What hangs on the loop is not in it.
TEST(ConstraintStress, IsInLoopsOfHingesWhateverTheirAxes) {
  for (const double angle : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1})
    for (const bool driven : {false, true}) {
      formats::Scene scene = square(JointKind::revolute, JointKind::revolute, {std::sin(angle), 0.0, std::cos(angle)});
      if (driven) scene.motions = {test_support::drive("A", "0.1 * t^2")};
      EXPECT_THAT(stressed(scene, beam_files()), ElementsAre(true, true, true, false)) << angle;
    }
}

TEST(ConstraintStress, IsNotWhereRigidBodiesFit) {
  for (const bool driven : {false, true}) {
    formats::Scene scene = square(JointKind::spherical, JointKind::cylindrical, z);
    if (driven) scene.motions = {test_support::drive("A", "0.1 * t^2")};
    EXPECT_THAT(stressed(scene, beam_files()), ElementsAre(false, false, false, false));
  }
}

// A modal body across two joints: a hinge and a line both hold its far end along the axis of the hinge.
TEST(ConstraintStress, IsInModesToo) {
  const test_support::Rod rod{0.0, 2.0, 4.0e-4, 2.1e11, 8.0e10, 2.0e-8, 7800.0, 8};
  BodyFiles files;
  files.modal_bodies["rod"].body =
      test_support::modal_body(test_support::lumped_rod(rod), test_support::rod_conditions(8), 10);
  for (const bool hinge : {true, false}) {
    formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
    scene.bodies.push_back(test_support::modal_spec("rod", "rod"));
    scene.joints = {
        test_support::joint("a", hinge ? JointKind::revolute : JointKind::spherical, "ground", "rod/n0", {0, 0, 0}, z),
        test_support::joint("b", JointKind::point_on_line, "ground", "rod/n8", {2, 0, 0}, Vector3d::UnitX())};
    EXPECT_THAT(stressed(scene, files), ElementsAre(hinge));
  }
}

// A cantilever of second order that a load across its tip bends by 0.04 of its length. Its stiffening switches on: its
// clamp goes on to bear the load. At the same places it would begin with the axial force of its shortening, EA times
// 6/5 (w/l)²/2, which is far above the load of 3 EI w/l².
TEST(StiffeningSwitch, KeepsTheLoadOfABentBody) {
  constexpr double EA = 1e6, EI = 200.0, length = 1.0, w = 0.04;
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(EA), length, 4);
  const BodyFiles files = test_support::files_of(test_support::second_order_beam(beam, {0, 4}, 2));
  const double load = 3.0 * EI * w / (length * length);
  formats::Scene scene = test_support::empty_scene(1e-4, 0.1);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  scene.joints = {test_support::joint("clamp", JointKind::fixed, "ground", "beam/n0", Vector3d::Zero(), z)};
  scene.loads = {test_support::constant_load("tip", formats::LoadKind::force, "beam/n4", {0, load, 0})};
  const auto with_stiffening = [&](bool on) {
    return *with_effects_switched(with_switches(scene, {{formats::Effect::stiffening, "beam", on}}), files);
  };
  formats::Scene at_rest = with_stiffening(false);
  at_rest.analysis = formats::AnalysisKind::statics;
  const RunEnd bent = simulate(RunRequest{at_rest, files, std::nullopt, "", "", std::nullopt}, {});
  Simulation linear(with_stiffening(false), files);
  const auto after = switch_model(with_stiffening(true), files, {linear.model(), bent.state}, {"beam"}, {});
  ASSERT_TRUE(after.has_value());
  ASSERT_GT(EA * 0.6 * w * w, 10.0 * load);
  EXPECT_LT(after->force, 0.01 * load);
  const auto back = switch_model(with_stiffening(false), files, {after->built.model, after->built.state}, {"beam"}, {});
  ASSERT_TRUE(back.has_value());
  EXPECT_LT(back->force, 0.01 * load);
  EXPECT_LT((back->built.state.x() - bent.state.x()).cwiseAbs().maxCoeff(), 1e-3 * w);
}

}  // namespace
}  // namespace tisserand::mechanism::constraint_stress_test

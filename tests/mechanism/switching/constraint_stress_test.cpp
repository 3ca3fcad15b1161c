// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that reactions can stress though no load acts.
#include "mechanism/switching/constraint_stress.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mechanism/build/effects.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/run/run.hpp"
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

}  // namespace
}  // namespace tisserand::mechanism::constraint_stress_test

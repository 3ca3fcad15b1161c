// SPDX-License-Identifier: GPL-3.0-or-later
// What one linear body does where benchmarks ask for it: the limits of the Princeton beam, and an internal mode far
// beyond the step.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::linear_bodies_test {
namespace {

using Eigen::Vector3d;
using test_support::BeamData;
using test_support::Simulation;

/// The Princeton beam (references/README.md); one element of the exact linear shapes.
BeamData princeton_beam() {
  BeamData beam;
  beam.length = 0.508;
  beam.young = 70e9;
  beam.shear_modulus = 70e9 / 2.6;
  beam.Iy = 36.2794 / beam.young;
  beam.Iz = 2.42873 / beam.young;
  beam.J = 3.10338 / beam.shear_modulus;
  beam.area = 2.84191e6 / beam.young;
  beam.shear_area_y = 6.40131e5 / beam.shear_modulus;
  beam.shear_area_z = 9.03881e5 / beam.shear_modulus;
  return beam;
}

/// Displacement of the tip under a dead force, as one body whose frame stays with the clamped node.
Vector3d tip_of_one_linear_body(const Vector3d& force) {
  SuperelementFiles files;
  test_support::add_file("beam", test_support::beam_superelement(princeton_beam()), files);
  formats::Scene scene = test_support::empty_scene(1.0, 1.0);
  scene.analysis = formats::AnalysisKind::statics;
  formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
  body.frame = formats::FrameKind::node;
  body.frame_node = "base";
  scene.bodies.push_back(body);
  scene.joints.push_back(
      test_support::joint("clamp", formats::JointKind::fixed, "ground", "beam/base", {0, 0, 0}, {0, 0, 1}));
  scene.loads.push_back(test_support::constant_load("tip", formats::LoadKind::force, "beam/tip", force));
  Simulation run(scene, files);
  run.start();
  const StaticsReport report = solve_statics(run.model(), scene.statics, {}, run.state(), run.workspace);
  EXPECT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  return run.position("beam/tip") - Vector3d(0.508, 0, 0);
}

// P L³/(3 EI) + P L/GA, whatever the load: on the weak side 2.5, 9 and 20 % more than the rod (reference rows at 90
// degrees); on the strong side the smallest load is still linear.
TEST(PrincetonBeam, OneLinearBodyDeflectsByTheLinearLimits) {
  const BeamData beam = princeton_beam();
  const double bending = beam.length * beam.length * beam.length / 3.0;
  std::vector<double> excess;
  for (const std::vector<double>& row : test_support::reference_rows("princeton_beam.csv")) {
    if (row[1] == 90.0) {
      const double limit = row[0] * (bending / 2.42873 + beam.length / 6.40131e5);
      const double found = tip_of_one_linear_body({0, row[0], 0}).y();
      EXPECT_NEAR(found, limit, 1e-6 * limit) << row[0] << " N";
      excess.push_back(found / row[3] - 1.0);
    }
    if (row[1] == 0.0 && row[0] < 5.0) {
      const double limit = row[0] * (bending / 36.2794 + beam.length / 9.03881e5);
      EXPECT_NEAR(tip_of_one_linear_body({0, 0, row[0]}).z(), limit, 1e-6 * limit);
      EXPECT_NEAR(limit, row[4], 2e-4 * row[4]);  // square of the slope, 1e-4, times a number of order one
    }
  }
  ASSERT_EQ(excess.size(), 3u);
  EXPECT_NEAR(excess[0], 0.025, 0.001);
  EXPECT_NEAR(excess[1], 0.094, 0.001);
  EXPECT_NEAR(excess[2], 0.196, 0.001);
}

/// Tip of a soft beam on a hinge after it fell for half a second; its one internal mode is put to 1e6 rad/s, or left
/// out.
Vector3d fallen_tip(int modes, double rho, double step) {
  formats::Superelement element = test_support::craig_bampton_beam(test_support::soft_beam(), 1);
  element.stiffness(12, 12) = 1e12;
  SuperelementFiles files;
  test_support::add_file("beam", element, files);
  formats::Scene scene = test_support::empty_scene(step, 0.5);
  scene.integrator.rho = rho;
  scene.gravity = {0, 0, -9.81};
  formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
  body.modes = modes;
  scene.bodies.push_back(body);
  scene.joints.push_back(
      test_support::joint("hinge", formats::JointKind::revolute, "ground", "beam/base", {0, 0, 0}, {0, 1, 0}));
  Simulation run(scene, files);
  run.start();
  run.run(0.5);
  return run.position("beam/tip");
}

// Its part of the motion is the acceleration over the square of its frequency, 1e-11; the rest moves as without it,
// with whatever dissipation of high frequencies, and with order 2.
TEST(VeryStiffMode, ChangesNothing) {
  for (const double rho : {0.0, 0.5, 0.9}) {
    SCOPED_TRACE(rho);
    const Vector3d with = fallen_tip(1, rho, 1e-3);
    EXPECT_LT((with - fallen_tip(0, rho, 1e-3)).norm(), 1e-6);
    const Vector3d finer = fallen_tip(1, rho, 5e-4), finest = fallen_tip(1, rho, 2.5e-4);
    EXPECT_NEAR(std::log2((with - finer).norm() / (finer - finest).norm()), 2.0, 0.3);
  }
}

// A cantilever under P along it and a force across: in the deformed shape P has P/P_cr π²/12 of the largest moment
// more.
TEST(DisplacedDoubt, SpeaksWhereForcesActOnDisplacedNodes) {
  const auto doubts = [](double share) {
    const BeamData beam;
    const double scale = beam.young * beam.Iy / (beam.length * beam.length);  // Euler's load between pins is π² of it
    BodyFiles files;
    test_support::add_file("beam", test_support::beam_superelement(beam), files.superelements);
    formats::Scene scene = test_support::empty_scene(1.0, 1.0);
    scene.analysis = formats::AnalysisKind::statics;
    scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
    scene.joints.push_back(
        test_support::joint("clamp", formats::JointKind::fixed, "ground", "beam/base", {0, 0, 0}, {0, 0, 1}));
    scene.loads.push_back(
        test_support::constant_load("tip", formats::LoadKind::force, "beam/tip",
                                    {-share * std::numbers::pi * std::numbers::pi * scale, 0, 0.3 * scale}));
    const test_support::TemporaryFolder folder;
    const RunRequest request{scene, files, std::nullopt, folder.file("a.results.h5"), "", std::nullopt};
    return ::testing::PrintToString(simulate(request, {}).report.doubts);
  };
  EXPECT_THAT(doubts(0.11), ::testing::Not(::testing::HasSubstr("of its largest moment")));
  EXPECT_THAT(doubts(0.2),
              ::testing::HasSubstr("the displaced nodes of 'beam' change the moment of the forces on it by"));
}

}  // namespace
}  // namespace tisserand::mechanism::linear_bodies_test

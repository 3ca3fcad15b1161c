// SPDX-License-Identifier: GPL-3.0-or-later
// Snap-through of a shallow frame of two reduced bodies (Williams' toggle frame, 1964), along the whole path, against
// geometrically exact beams.
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/preload/preloaded_scenes.hpp"

namespace tisserand::preload::toggle_frame_test {
namespace {

using Eigen::Vector3d;
using test_support::Simulation;

// F. W. Williams, An approach to the nonlinear behaviour of the members of a rigid jointed plane framework with finite
// deflections, Quarterly Journal of Mechanics and Applied Mathematics 17 (1964) 451-469: in, lb.
constexpr double half_span = 12.943, rise = 0.386, width = 0.753, depth = 0.243, E = 1.03e7;
constexpr double k = 150.0;  ///< of a spring below the apex, which keeps the path of loads upward

formats::Section bar() {
  formats::Section section;
  section.area = width * depth;
  section.second_moment_y = width * std::pow(depth, 3) / 12.0;
  section.second_moment_z = depth * std::pow(width, 3) / 12.0;
  section.polar_moment = section.second_moment_y + section.second_moment_z;
  section.torsion_constant = 0.28 * width * std::pow(depth, 3);
  section.shear_area_y = section.shear_area_z = 5.0 / 6.0 * section.area;
  return section;
}
const formats::Material steel{"m", E, 0.3, 7.3e-4, ""};
const Vector3d apex(half_span, 0, rise), end(2.0 * half_span, 0, 0);

testing::ReducedPart reduced_bar(int modes) {
  reducer::Mesh mesh;
  reducer::BeamElementData data;
  data.material = steel;
  data.section = bar();
  mesh.beam_properties = {{data, "bar"}};
  constexpr int elements = 24;
  for (int i = 0; i <= elements; ++i) testing::add_node(mesh, Vector3d(apex.norm() * i / elements, 0, 0));
  for (int i = 0; i < elements; ++i) testing::add_beam(mesh, i, i + 1, Vector3d::UnitY());
  mesh.boundary = {{"base", 0, true, true}, {"tip", elements, true, true}};
  return testing::reduce_with_companion(mesh, modes);
}

/// Clamped ends, a stiff apex with force and spring down; `first` and `second`: node at the apex of either half.
void finish(formats::Scene& scene, const std::string& base, const std::string& first, const std::string& second,
            const std::string& tip, double force) {
  const auto fixed = [&](const std::string& a, const std::string& b, const Vector3d& at) {
    scene.joints.push_back(test_support::joint("at_" + std::to_string(scene.joints.size()), formats::JointKind::fixed,
                                               a, b, at, Vector3d::UnitZ()));
  };
  scene.analysis = formats::AnalysisKind::statics;
  scene.statics.load_steps = 10;
  fixed("ground", base, Vector3d::Zero());
  fixed(first, second, apex);
  fixed(tip, "ground", end);
  scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, first, {0, 0, -force}));
  formats::BushingSpec spring;
  spring.name = "spring";
  spring.a.node = "ground";
  spring.b.node = first;
  spring.position = apex;
  spring.stiffness(2, 2) = k;
  scene.bushings.push_back(spring);
}

/// How far the apex goes down; none without equilibrium.
std::optional<double> sag(Simulation& run, const std::string& node) {
  run.start();
  const auto statics = mechanism::solve_statics(run.model(), run.scene.statics, {}, run.state(), run.workspace);
  if (statics.outcome != mechanism::StepOutcome::accepted) return std::nullopt;
  return rise - run.position(node).z();
}

std::optional<double> sag_of_bodies(const mechanism::BodyFiles& files, double force, bool second_order) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  const double slope = std::atan2(rise, half_span);
  for (const bool left : {true, false}) {
    formats::SuperelementBodySpec body = test_support::superelement_body(left ? "left" : "right", "part");
    body.second_order = second_order;
    body.start.pose.position = left ? Vector3d(0, 0, 0) : apex;
    body.start.pose.orientation = Eigen::AngleAxisd(left ? -slope : slope, Vector3d::UnitY());
    scene.bodies.push_back(body);
  }
  finish(scene, "left/base", "left/tip", "right/base", "right/tip", force);
  Simulation run(scene, files);
  return sag(run, "left/tip");
}

std::optional<double> sag_of_beams(double force) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  for (const bool left : {true, false}) {
    formats::BeamBodySpec body;
    body.name = left ? "left" : "right";
    body.from = left ? Vector3d(0, 0, 0) : apex;
    body.to = left ? apex : end;
    body.orientation = Vector3d::UnitY();
    body.elements = 10;
    body.nodes_per_element = 3;
    body.section = bar();
    body.material = steel;
    scene.bodies.push_back(body);
  }
  finish(scene, "left/start", "left/end", "right/start", "right/end", force);
  Simulation run(scene, {});
  return sag(run, "left/20");
}

// The frame bears 33.8, then less, then more (forces less the spring's). Four modes follow the beams to a fifth of a
// per cent of the rise all the way; linear bodies never give way.
TEST(ToggleFrame, SnapsThroughAsTheExactBeamsDo) {
  const mechanism::BodyFiles files = files_of(reduced_bar(4));
  double top = 0.0, after = 0.0;
  for (const double force : {20.0, 50.0, 70.0, 90.0, 110.0, 140.0, 180.0}) {
    const double exact = sag_of_beams(force).value(), found = sag_of_bodies(files, force, true).value();
    EXPECT_NEAR(found, exact, 2e-3 * rise) << force;
    if (force == 70.0) top = force - k * found;
    if (force == 90.0) after = force - k * found;
  }
  EXPECT_NEAR(top, 33.8, 0.3);
  EXPECT_LT(after, top - 2.0);
  EXPECT_GT(std::abs(sag_of_bodies(files, 110.0, false).value() - sag_of_beams(110.0).value()), 0.5 * rise);
}

}  // namespace
}  // namespace tisserand::preload::toggle_frame_test

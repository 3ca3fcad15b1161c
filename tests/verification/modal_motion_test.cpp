// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of modal bodies: conserved quantities, the slider-crank of [GA00] 4.3, agreement with superelements and
// nonlinear beams where deformations are small.
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/results/results.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::modal_motion_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;

/// Position of a place at the last state, whether a joint acts there or not.
Vector3d place(test_support::Simulation& run, const std::string& name) {
  evaluate(run.model(), run.state(), run.workspace.now);
  update_modal_nodes(run.model(), run.workspace.now);
  for (const Place& p : run.model().places)
    if (p.name == name) return marker_position(p.marker, motion_of(run.workspace.now, p.marker.node));
  throw std::runtime_error("no place " + name);
}

// ---- free flight -------------------------------------------------------------------------------------------------

/// Relative drifts over one second of a deformed, spinning body that nothing acts on.
struct Drift {
  double energy = 0.0, linear = 0.0, angular = 0.0;
};

Drift free_flight(const std::string& reference, double step) {
  const nlohmann::json answers = test_support::modal_answers();
  BodyFiles files;
  files.modal_bodies["body"].body = test_support::known_body(answers, reference);
  formats::Scene scene = test_support::empty_scene(step, 1.0);
  scene.integrator.rho = 1.0;
  scene.bodies.push_back(test_support::modal_spec("body", "body"));
  auto& start = std::get<formats::ModalBodySpec>(scene.bodies[0]).start;
  start.velocity = {0.7, -1.1, 0.4};
  start.angular_velocity = {1.3, -0.8, 2.1};
  test_support::Simulation run(scene, files);
  run.state().w() = Vector3d(0.05, -0.04, 0.03);
  run.start();
  const auto momenta = [&run] {
    evaluate(run.model(), run.state(), run.workspace.now);
    tangent(run.model().modal_bodies[0], {1, 0, 0}, run.workspace.now.modal_bodies[0]);
    const VectorXd p = run.workspace.now.modal_bodies[0].tangent * run.state().v();
    const NodeMotion& frame = run.workspace.now.motion[0];
    Eigen::Matrix<double, 6, 1> sum;
    sum << p.head<3>(), frame.x.cross(p.head<3>()) + frame.R * p.segment<3>(3);
    return sum;
  };
  const Eigen::Matrix<double, 6, 1> momenta0 = momenta();
  const double energy0 = run.energy().total();
  Drift drift;
  run.run(1.0, [&] {
    const Eigen::Matrix<double, 6, 1> change = momenta() - momenta0;
    drift.linear = std::max(drift.linear, change.head<3>().norm() / momenta0.head<3>().norm());
    drift.angular = std::max(drift.angular, change.tail<3>().norm() / momenta0.tail<3>().norm());
    drift.energy = std::max(drift.energy, std::abs(run.energy().total() - energy0) / energy0);
  });
  return drift;
}

// What is left is the error of the integrator: it falls with the square of the step, and does not level off. Without
// the gyroscopic term of the rotary inertias the angular momentum of this body drifts by 1e-1, whatever the step.
TEST(ModalMotion, FreeBodyKeepsItsMomentaAndEnergy) {
  for (const char* reference : {"node_fixed", "mean_axis"}) {
    const Drift coarse = free_flight(reference, 4e-3), fine = free_flight(reference, 1e-3);
    EXPECT_LT(fine.energy, 1e-4) << reference;
    EXPECT_LT(fine.linear, 1e-4) << reference;
    EXPECT_LT(fine.angular, 1e-4) << reference;
    EXPECT_NEAR(coarse.angular / fine.angular, 16.0, 3.0) << reference;
    EXPECT_NEAR(coarse.energy / fine.energy, 16.0, 3.0) << reference;
  }
}

TEST(ModalMotion, ReportCountsGravityOfAModalBodyAlone) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  formats::ModalBodySpec body;
  body.name = "rod";
  body.file = TISSERAND_SOURCE_DIR "/examples/modal_slider_crank/rod.modal.h5";
  scene.bodies.emplace_back(body);
  EXPECT_THAT(inspect(scene, {}).effects, ::testing::Not(::testing::Contains("gravity")));
  scene.gravity = {0.0, 0.0, -9.81};
  EXPECT_THAT(inspect(scene, {}).effects, ::testing::Contains("gravity"));
}

// ---- slider-crank of [GA00] 4.3 ------------------------------------------------------------------------------------

constexpr double crank = 0.1524, rod = 0.3048, speed = 124.8;

/// The slider has no mass and does not turn: its guide holds the end of the rod, and one axis of it.
formats::Scene slider_crank(double step) {
  formats::Scene scene = test_support::empty_scene(step, 0.02);
  formats::RigidBodySpec wheel = test_support::rigid_body("crank", 10.0, {crank / 2, 0, 0}, {0.01, 0.02, 0.02});
  wheel.start.angular_velocity = {0, 0, speed};
  formats::ModalBodySpec flexible = test_support::modal_spec("rod", "rod");
  flexible.start.pose.position = {crank, 0, 0};
  flexible.start.velocity = {0, crank * speed, 0};
  flexible.start.angular_velocity = {0, 0, -crank * speed / rod};
  scene.bodies = {wheel, flexible};
  scene.joints = {test_support::joint("drive", JointKind::revolute, "ground", "crank", Vector3d::Zero(), {0, 0, 1}),
                  test_support::joint("pin", JointKind::spherical, "crank", "rod/n0", {crank, 0, 0}, {0, 0, 1}),
                  test_support::joint("guide", JointKind::generic, "ground", "rod/n8", {crank + rod, 0, 0}, {0, 0, 1})};
  scene.joints[2].axis.reset();
  scene.joints[2].hold = {false, true, true, true, false, false};
  scene.motions.push_back({"drive", {"drive", ""}, formats::TimeExpression{"124.8*t", {}, ""}, ""});
  return scene;
}

/// Largest difference of deflection/length and of slider/length to the known answers, every millisecond to 20 ms.
struct Difference {
  double deflection = 0.0, slider = 0.0;
};

Difference slider_crank_difference(double step) {
  const nlohmann::json known = test_support::modal_answers().at("slider_crank");
  BodyFiles files;
  files.modal_bodies["rod"].body =
      test_support::modal_body(test_support::lumped_rod(test_support::paper_rod()), test_support::rod_conditions(8), 6);
  test_support::Simulation run(slider_crank(step), files);
  run.start();
  Difference worst;
  for (std::size_t i = 1; i < known.at("t").size(); ++i) {
    run.run(known.at("t")[i].get<double>());
    const Vector3d from = place(run, "rod/n0"), along = place(run, "rod/n8") - from,
                   middle = place(run, "rod/n4") - from;
    const double deflection = (along.x() * middle.y() - along.y() * middle.x()) / along.norm() / rod;
    worst.deflection =
        std::max(worst.deflection, std::abs(deflection - known.at("deflection_over_length")[i].get<double>()));
    worst.slider = std::max(worst.slider, std::abs(from.x() + along.x() - known.at("slider_x")[i].get<double>()) / rod);
  }
  return worst;
}

// The reference is exact to 1e-8. Generalised-alpha (rho 0.9) with h stretches the period of the first mode (866 rad/s)
// by about (866 h)²/10, which shifts the curve by up to 1e-5 after 20 ms at h = 2e-5; the error falls with h².
TEST(ModalMotion, SliderCrankFollowsTheCurveOfTheLinearBody) {
  const Difference coarse = slider_crank_difference(4e-5), fine = slider_crank_difference(2e-5);
  EXPECT_LT(fine.deflection, 1e-5);
  EXPECT_LT(fine.slider, 1e-5);
  EXPECT_NEAR(coarse.deflection / fine.deflection, 4.0, 0.6);
}

TEST(ModalMotion, ExampleHoldsTheRodOfTheFixture) {
  const std::string folder = std::string(TISSERAND_SOURCE_DIR) + "/examples/modal_slider_crank/";
  const formats::ModalBody made =
      test_support::modal_body(test_support::lumped_rod(test_support::paper_rod()), test_support::rod_conditions(8), 6);
  const formats::ModalBody stored = formats::read_modal_body(folder + "rod.modal.h5").body;
  // Bending modes come in pairs of one frequency, which an eigenvalue solver may turn: what does not depend on that.
  EXPECT_LT(test_support::relative_difference(stored.omega2, made.omega2), 1e-9);
  EXPECT_EQ(stored.node_position, made.node_position);
  for (std::size_t k = 0; k < made.X.size(); ++k)
    EXPECT_LT((stored.X[k] * stored.X[k].transpose() - made.X[k] * made.X[k].transpose()).cwiseAbs().maxCoeff(),
              1e-8 * made.X[k].squaredNorm() + 1e-8);
}

// The scene as it lies in the examples: the first peak is that of the linear body, 0.01035 at 5.7 ms.
TEST(ModalMotion, ExampleReachesThePeakOfTheLinearBody) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.file("slider_crank.results.h5");
  const formats::Scene scene = formats::read_scene(
      std::string(TISSERAND_SOURCE_DIR) + "/examples/modal_slider_crank/slider_crank.scene.yaml", {});
  ASSERT_EQ(simulate(scene, path, RunControl{}).outcome, RunOutcome::completed);
  const formats::ResultsReader results(path);
  const auto column = [&](const std::string& node, const char* axis) {
    return results.read("nodes/position/rod/" + node + "/" + axis);
  };
  const auto x0 = column("n0", "x"), y0 = column("n0", "y"), x4 = column("n4", "x"), y4 = column("n4", "y"),
             x8 = column("n8", "x"), y8 = column("n8", "y");
  double peak = 0.0, at = 0.0;
  for (std::size_t i = 0; i < x0.size(); ++i) {
    const double a = x8[i] - x0[i], b = y8[i] - y0[i];
    const double deflection = (a * (y4[i] - y0[i]) - b * (x4[i] - x0[i])) / std::hypot(a, b) / rod;
    if (deflection > peak) peak = deflection, at = results.time()[i];
  }
  EXPECT_NEAR(peak, 0.01035, 5e-5);  // stored every half millisecond: flat within 5e-5 around the peak
  EXPECT_NEAR(at, 0.0057, 3e-4);
  EXPECT_EQ(results.read("modal_bodies/w/rod/0").size(), x0.size());
}

// Small motions of the rod, turned by 90 degrees about z, on a hinge across it: of a node that of the frame, its turn x
// the arm, and A X w.
TEST(ModalMotion, ModesMoveTheNodes) {
  const test_support::TemporaryFolder folder;
  const std::string file = std::string(TISSERAND_SOURCE_DIR) + "/examples/modal_slider_crank/rod.modal.h5";
  const std::string path = folder.file("tones.results.h5");
  std::ofstream(folder.file("tones.yaml")) << fmt::format(R"(scene: tones
bodies: {{rod: {{type: modal, file: {}, pose: {{orientation: {{axis: [0, 0, 1], angle_deg: 90}}}}}}}}
joints: {{hinge: {{type: revolute, a: ground, b: rod/n0, axis: [1, 0, 0]}}}}
analysis: modes
modes: {{count: 7}}
)",
                                                          file);
  ASSERT_EQ(simulate(formats::read_scene(folder.file("tones.yaml"), {}), path, RunControl{}).outcome,
            RunOutcome::completed);
  const formats::ResultsReader results(path);
  const formats::ModalBody body = formats::read_modal_body(file).body;
  const auto shape = [&](const std::string& name, std::size_t mode) {
    return Vector3d(results.read("modes/" + name + "/x/real")[mode], results.read("modes/" + name + "/y/real")[mode],
                    results.read("modes/" + name + "/z/real")[mode]);
  };
  const auto place = [&](const std::string& node) {
    return Vector3d(results.read("nodes/position/" + node + "/x")[0], results.read("nodes/position/" + node + "/y")[0],
                    results.read("nodes/position/" + node + "/z")[0]);
  };
  const Eigen::Matrix3d A = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitZ()).toRotationMatrix();
  ASSERT_EQ(results.modes(), 7u);  // six of the rod and six of its frame, less five of the hinge
  double largest = 0.0;
  for (std::size_t mode = 0; mode < 7; ++mode)
    for (const std::size_t k : {std::size_t{0}, std::size_t{3}, std::size_t{8}}) {
      const std::string node = "rod/" + body.node_name[k];
      Eigen::VectorXd w(body.omega2.size());
      for (Eigen::Index j = 0; j < w.size(); ++j) w[j] = results.read(fmt::format("modes/w/rod/{}/real", j))[mode];
      const Vector3d expected = shape("translation/rod", mode) +
                                shape("rotation/rod", mode).cross(place(node) - place("rod")) +
                                A * body.X[k].topRows<3>() * w;
      EXPECT_LT((shape("translation/" + node, mode) - expected).norm(), 1e-9) << node << " " << mode;
      largest = std::max(largest, expected.norm());
    }
  EXPECT_GT(largest, 1e-3);
}

// Rotations of modes are in world axes: a body turned by 90 degrees about z, that swings about the y axis of the world.
TEST(ModalMotion, ModesTurnAboutWorldAxes) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.file("swing.results.h5");
  std::ofstream(folder.file("swing.yaml")) << R"(scene: swing
bodies: {bar: {type: rigid, mass: 1, inertia: [1, 1, 1], nodes: {tip: {position: [2, 0, 0]}}, pose: {orientation: {axis: [0, 0, 1], angle_deg: 90}}}}
joints: {hinge: {type: revolute, a: ground, b: bar, axis: [1, 0, 0]}}
springs: {coil: {coordinate: hinge, stiffness: 4}}
analysis: modes
)";
  ASSERT_EQ(simulate(formats::read_scene(folder.file("swing.yaml"), {}), path, RunControl{}).outcome,
            RunOutcome::completed);
  const formats::ResultsReader results(path);
  // The tip is at (0, 2, 0): a turn about x moves it along z by twice as much.
  const double turn = results.read("modes/rotation/bar/x/real")[0];
  EXPECT_GT(std::abs(turn), 0.1);
  EXPECT_NEAR(results.read("modes/rotation/bar/y/real")[0], 0.0, 1e-12);
  EXPECT_NEAR(results.read("modes/translation/bar/tip/z/real")[0], 2.0 * turn, 1e-12);
  EXPECT_NEAR(results.read("modes/translation/bar/tip/x/real")[0], 0.0, 1e-12);
}

// ---- agreement with other bodies -----------------------------------------------------------------------------------

/// The lumped model as a superelement whose nodes are all boundary nodes.
formats::Superelement superelement_of(const test_support::LumpedModel& model) {
  formats::Superelement element;
  element.name = "rod";
  element.units = Units::si();
  element.node_name = model.name;
  element.node_position = model.position;
  element.stiffness = model.stiffness;
  element.mass.setZero(model.stiffness.rows(), model.stiffness.cols());
  for (Eigen::Index k = 0; k < model.nodes(); ++k) {
    for (int component = 0; component < 6; ++component) {
      element.dof_node.push_back(static_cast<int>(k));
      element.dof_component.push_back(component);
    }
    element.mass.block<3, 3>(6 * k, 6 * k) = model.mass[k] * Eigen::Matrix3d::Identity();
    element.mass.block<3, 3>(6 * k + 3, 6 * k + 3) = model.inertia[k];
  }
  return element;
}

/// The rod clamped at its start, with a force of 0.5 N across its end from rest: its deflection swings up to 2e-3 of
/// the length, twice the static one. Deflections of the end, 80 steps over two periods.
VectorXd cantilever(const formats::BodySpec& body, const BodyFiles& files, const std::string& start,
                    const std::string& end) {
  formats::Scene scene = test_support::empty_scene(5e-4, 0.04);
  scene.bodies.push_back(body);
  scene.joints.push_back(test_support::joint("clamp", JointKind::fixed, "ground", start, Vector3d::Zero(), {0, 0, 1}));
  scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, end, {0, 0.5, 0}));
  test_support::Simulation run(scene, files);
  run.start();
  VectorXd deflection(80);
  int row = 0;
  run.run(0.04, [&] { deflection[row++] = place(run, end).y(); });
  return deflection;
}

TEST(ModalMotion, SmallDeformationsAgreeWithSuperelementAndNonlinearBeams) {
  const test_support::Rod properties = test_support::paper_rod();
  const test_support::LumpedModel model = test_support::lumped_rod(properties);
  SuperelementFiles superelements;
  test_support::add_file("rod", superelement_of(model), superelements);
  BodyFiles files(superelements);
  files.modal_bodies["fixed"].body = test_support::modal_body(model, test_support::rod_conditions(8), 48);
  files.modal_bodies["mean"].body = test_support::modal_body(model, {}, 48);
  const VectorXd fixed = cantilever(test_support::modal_spec("rod", "fixed"), files, "rod/n0", "rod/n8");
  const VectorXd mean = cantilever(test_support::modal_spec("rod", "mean"), files, "rod/n0", "rod/n8");
  const VectorXd full = cantilever(test_support::superelement_body("rod", "rod"), files, "rod/n0", "rod/n8");
  formats::BeamBodySpec beam;
  beam.name = "rod";
  beam.to = {rod, 0, 0};
  beam.elements = 8;
  beam.nodes_per_element = 3;
  beam.section.area = properties.area;
  beam.section.second_moment_y = beam.section.second_moment_z = properties.I;
  beam.section.torsion_constant = beam.section.polar_moment = 2.0 * properties.I;
  beam.section.shear_area_y = beam.section.shear_area_z = 0.9 * properties.area;
  beam.material.youngs_modulus = properties.E;
  beam.material.poisson_ratio = 0.3;
  beam.material.density = properties.density;
  const VectorXd nonlinear = cantilever(beam, files, "rod/0", "rod/16");
  const double largest = full.cwiseAbs().maxCoeff(), length = rod;
  EXPECT_NEAR(largest, 2.0 * 0.5 * std::pow(rod, 3) / (3.0 * properties.E * properties.I), 0.1 * largest);
  // With every mode all three are the same linear body: what differs is of second order in the deformation.
  const double second_order = 3.0 * largest * largest / length;
  EXPECT_LT((fixed - full).cwiseAbs().maxCoeff(), second_order);
  EXPECT_LT((mean - full).cwiseAbs().maxCoeff(), second_order);
  // Lumped and consistent masses differ in the first frequency by 0.5 %, in phase by 6 % of a radian after two periods.
  EXPECT_LT((nonlinear - full).cwiseAbs().maxCoeff(), 0.06 * largest);
}

}  // namespace
}  // namespace tisserand::mechanism::modal_motion_test

// SPDX-License-Identifier: GPL-3.0-or-later
// No heap allocation inside an accepted step without output, whatever the model holds.
#include <gtest/gtest.h>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::allocation_test {
namespace {

using Eigen::Vector3d;
using formats::Formulation;
using formats::JointKind;
using formats::LinearSolver;

formats::Scene everything() {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.gravity = {0, 0, -9.81};
  formats::SuperelementBodySpec frame = test_support::superelement_body("frame", "frame");
  frame.damping = {.mass = 0.1, .stiffness = 1e-4, .ratio = 0.01, .ratios = {}};
  scene.bodies.push_back(frame);
  scene.bodies.push_back(test_support::rigid_body("block", 2.0, {1.6, 1.0, 0.7}, {0.3, 0.4, 0.5}));
  for (const int nodes : {2, 3}) {
    formats::BeamBodySpec beam;
    beam.name = nodes == 2 ? "beam2" : "beam3";
    beam.from = nodes == 2 ? Vector3d(1.5, 1.0, 0.7) : Vector3d(0, 0, 0);
    beam.to = nodes == 2 ? Vector3d(2.5, 1.0, 0.7) : Vector3d(-1, 0.2, 0);
    beam.elements = 2;
    beam.nodes_per_element = nodes;
    beam.section = test::rectangle(0.1, 0.2, 4e-5, 5.0 / 6.0);
    beam.material = test::material(1e6, 0.3, 10.0);
    scene.bodies.push_back(beam);
  }
  scene.joints = {test_support::joint("fixed", JointKind::fixed, "frame/n5", "block", {1.5, 1.0, 0.7}, {1, 2, 3}),
                  test_support::joint("hinge", JointKind::revolute, "block", "beam2/start", {1.5, 1.0, 0.7}, {0, 1, 1}),
                  test_support::joint("ball", JointKind::spherical, "ground", "beam3/start", {0, 0, 0}, {0, 0, 1}),
                  test_support::joint("root", JointKind::revolute, "frame/n0", "beam3/start", {0, 0, 0}, {0, 1, 0})};
  formats::ModalBodySpec modal = test_support::modal_spec("modal", "modal");
  modal.damping.ratio = 0.01;
  modal.start.pose.position = {3.0, 1.0, 0.7};
  scene.bodies.push_back(modal);
  scene.joints.push_back(
      test_support::joint("hang", JointKind::revolute, "ground", "modal/n1", {3.0, 1.0, 0.7}, {0, 1, 0}));
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.a.node = "block";
  spring.b.node = "modal/n5";
  spring.stiffness = 10.0;
  spring.damping = 1.0;
  scene.springs.push_back(spring);
  scene.loads = {test_support::constant_load("force", formats::LoadKind::force, "beam2/end", {1, 2, 3}),
                 test_support::constant_load("moment", formats::LoadKind::moment, "block", {1, 0, 0}),
                 test_support::constant_load("tip", formats::LoadKind::force, "modal/n4", {1, 0, 0})};
  scene.loads[0].components[0] = formats::TimeTable{{0.0, 10.0}, {0.0, 30.0}};
  scene.loads[1].components[1] = formats::TimeExpression{"sin(20*t) + drive - speed", {}, ""};
  scene.joints[1].friction = formats::FrictionSpec{0.1, {}, 0.1, 0.02, {}};
  scene.inputs = {{"drive", {{0.0, 0.01, 10.0}, {0.0, 1.0, 2.0}}, formats::Interpolation::cubic, ""}};
  scene.channels.resize(1);
  scene.channels[0].name = "speed";
  scene.channels[0].kind = formats::ChannelKind::rate;
  scene.channels[0].coordinate.name = "hinge";
  scene.bushings.resize(1);
  scene.bushings[0].a.node = "ground";
  scene.bushings[0].b.node = "block";
  scene.bushings[0].stiffness.diagonal().setConstant(10.0);
  formats::RoadSpec& road = scene.roads.emplace_back();
  road.name = "road";
  road.pose.position = {0, 0, -0.34};
  formats::TyreSpec& tyre = scene.tyres.emplace_back();
  tyre.wheel.node = "block";
  tyre.wheel.position = Vector3d(0, 0, 0);
  tyre.axis = Vector3d(0, 1, 1);
  tyre.road = "road";
  tyre.radius = 0.5;
  tyre.stiffness = tyre.slip_stiffness = tyre.cornering_stiffness = 10.0;
  tyre.friction = tyre.low_speed = 1.0;
  formats::SpringSpec& along = scene.springs.emplace_back();
  along.coordinate = formats::CoordinateRef{"hinge", ""};
  along.stiffness = formats::CurveSpec{formats::Interpolation::cubic, {-1.0, 1.0}, {-3.0, 3.0}};
  along.force = formats::TimeExpression{"-0.1*speed", {}, ""};
  return scene;
}

TEST(AcceptedStep, AllocatesNothing) {
  SuperelementFiles superelements;
  test_support::add_file("frame", test_support::test_superelement("frame"), superelements);
  BodyFiles files(superelements);
  files.modal_bodies["modal"].body = test_support::known_body(test_support::modal_answers(), "node_fixed");
  for (const Formulation formulation : {Formulation::index3, Formulation::stabilised_index2})
    for (const LinearSolver solver : {LinearSolver::klu, LinearSolver::dense}) {
      formats::Scene scene = everything();
      scene.integrator.formulation = formulation;
      scene.integrator.linear_solver = solver;
      test_support::Simulation run(scene, files);
      run.start();
      run.run(0.005);
      const long factorisations = run.factorisations;
      std::size_t allocations = 0;
      for (int i = 0; i < 40; ++i) {
        // New factors every fifth step, which the rule of reuse might not ask for in so short a run.
        if (i % 5 == 0) run.workspace.matrix.invalidate();
        const StepEnd end = run.schedule.next(run.state().time());
        const std::size_t before = test_support::allocation_count();
        run.report = advance(run.model(), run.scene.integrator, end, run.state(), run.workspace);
        allocations += test_support::allocation_count() - before;
        run.factorisations += run.report.factorisations;
        ASSERT_EQ(run.report.outcome, StepOutcome::accepted);
        run.schedule.accept(run.state().time());
      }
      EXPECT_EQ(allocations, 0u) << (solver == LinearSolver::klu ? "KLU" : "dense");
      EXPECT_GE(run.factorisations - factorisations, 8);
    }
}

}  // namespace
}  // namespace tisserand::mechanism::allocation_test

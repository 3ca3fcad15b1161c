// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies, beams, superelements and modal bodies of about 2 kg and 2 m, soft, without a plane of symmetry.
#include "tests/support/crossings/arms.hpp"

#include <utility>

#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"

namespace tisserand::test_support::crossings {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

const Vector3d rigid_tip(1.2, 0.5, 0.3), frame_tip(1.5, 1.0, 0.7), straight_tip(1.0, 0.0, 0.0);

formats::RigidBodySpec rigid_arm() {
  formats::RigidBodySpec body;
  body.name = "arm";
  body.mass = 2.0;
  body.center_of_mass = {0.6, 0.3, 0.1};
  body.inertia = turned_inertia({0.1, 0.3, 0.35});
  const Eigen::Quaterniond askew(Eigen::AngleAxisd(0.8, Vector3d(1, -1, 2).normalized()));
  body.nodes = {{"tip", {rigid_tip, askew}}};
  return body;
}

formats::BeamBodySpec beam_arm(int nodes) {
  formats::BeamBodySpec beam;
  beam.name = "arm";
  beam.to = rigid_tip;
  if (nodes == 3) beam.through = Vector3d(0.7, 0.1, 0.3);
  beam.orientation = Vector3d(0.1, -0.3, 1.0);
  beam.elements = 3;
  beam.nodes_per_element = nodes;
  formats::Section& section = beam.section;
  section.by_stiffness = true;
  section.area = 1e3;
  section.shear_area_y = section.shear_area_z = 400.0;
  section.second_moment_y = 20.0;
  section.second_moment_z = 30.0;
  section.torsion_constant = 16.0;
  section.polar_moment = 50.0;
  section.mass_per_length = 1.2;
  section.rotary_inertia_y = 0.02;
  section.rotary_inertia_z = 0.03;
  beam.material = formats::unit_material("");
  return beam;
}

formats::SuperelementBodySpec reduced_arm(Arm arm) {
  formats::SuperelementBodySpec body = superelement_body("arm", arm == Arm::second_order ? "second_order"
                                                                : arm == Arm::mixed      ? "mixed"
                                                                                         : "frame");
  switch (arm) {
    case Arm::use_rigid:
      body.rigid = true;
      break;
    case Arm::karcher_B:
    case Arm::automatic:
      body.damping.ratio = 0.02;
      break;
    case Arm::node_A:
      body.frame = formats::FrameKind::node;
      body.frame_node = "n2";
      body.inertia = formats::InertiaOption::A;
      body.damping.stiffness = 1e-3;
      break;
    case Arm::paper_B:
      body.frame = formats::FrameKind::paper;
      body.damping.mass = 0.3;
      break;
    case Arm::weighted_M:
      body.inertia = formats::InertiaOption::M;
      body.position_weights = {{"n0", 0.5}, {"n2", 0.3}, {"n5", 0.2}};
      body.rotation_weights = {{"n0", 0.2}, {"n2", 0.2}, {"n5", 0.6}};
      body.damping.ratio_internal = 0.05;
      break;
    default:
      break;
  }
  return body;
}

formats::ModalBodySpec modal_arm() {
  formats::ModalBodySpec body;
  body.name = "arm";
  body.file = "modal";
  body.damping.ratios = {0.02, 0.01};
  return body;
}

formats::BodySpec body_of(Arm arm) {
  switch (arm) {
    case Arm::rigid:
    case Arm::welded:
      return rigid_arm();
    case Arm::beam_2:
      return beam_arm(2);
    case Arm::beam_3:
      return beam_arm(3);
    case Arm::modal:
      return modal_arm();
    default:
      return reduced_arm(arm);
  }
}

/// The lumped model of the bent frame: masses of half its pieces, rotary inertias all unequal.
LumpedModel lumped_frame() {
  const FullModel frame = bent_frame();
  LumpedModel model;
  model.position = frame.position;
  model.stiffness = frame.S;
  model.mass.resize(6);
  model.mass << 0.4, 0.75, 0.6, 0.5, 0.6, 0.35;
  for (int k = 0; k < 6; ++k) {
    model.name.push_back("n" + std::to_string(k));
    model.inertia.push_back(turned_inertia({0.010 + 0.001 * k, 0.016, 0.019}));
  }
  return model;
}

mechanism::BodyFiles made_files() {
  mechanism::BodyFiles files;
  add_file("frame", test_superelement("frame"), files.superelements);
  add_file("mixed", test_superelement("mixed"), files.superelements);
  const BernoulliBeam beam = bernoulli_beam(slender_section(1e4), 1.0, 4);
  SecondOrderBody second = second_order_beam(beam, {0, 2, 4}, 4);
  add_file("second_order", second.element, files.superelements);
  formats::check(second.companion, second.element, "second_order");
  second.companion.companion_id = formats::companion_id(second.companion);
  files.companions["second_order"] = second.companion;
  files.modal_bodies["modal"].body = modal_body(lumped_frame(), {}, 6);
  return files;
}

}  // namespace

Matrix3d turned_inertia(const Vector3d& principal) {
  const Matrix3d R = Eigen::AngleAxisd(0.6, Vector3d(0.4, 1.0, -0.3).normalized()).toRotationMatrix();
  const Matrix3d J = R * principal.asDiagonal() * R.transpose();
  return 0.5 * (J + J.transpose());
}

Eigen::Quaterniond arm_orientation() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(0.9, Vector3d(-0.3, 0.5, 0.8).normalized()));
}

Vector3d tip_in_part(Arm arm) {
  switch (arm) {
    case Arm::rigid:
    case Arm::welded:
    case Arm::beam_2:
    case Arm::beam_3:
      return rigid_tip;
    case Arm::second_order:
      return straight_tip;
    default:
      return frame_tip;
  }
}

void add_arm(Arm arm, formats::Scene& scene) {
  formats::BodySpec body = body_of(arm);
  const formats::Pose pose{root_place(), arm_orientation()};
  std::visit([&](auto& spec) { spec.start.pose = pose; }, body);
  scene.bodies.push_back(std::move(body));
  if (arm == Arm::automatic) {
    scene.effects.push_back({formats::Effect::flexibility, "arm", true, "", true});
    scene.automatic.tolerance = 1e-2;
  }
  if (arm != Arm::welded) return;
  formats::VirtualBodySpec hub;
  hub.name = "hub";
  hub.start.pose = {root_place() + arm_orientation() * Vector3d(0.5, 0.2, -0.1),
                    Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(2, 1, -1).normalized()))};
  const Vector3d tip = hub.start.pose.orientation.conjugate() * (tip_place(arm) - hub.start.pose.position);
  hub.nodes = {{"tip", {tip, Eigen::Quaterniond::Identity()}}};
  scene.bodies.emplace_back(hub);
  scene.joints.push_back(joint("weld", formats::JointKind::fixed, "arm", "hub", hub.start.pose.position, hinge_axis()));
  scene.joints.back().x_axis = hinge_x_axis();
}

std::string root_node(Arm arm) {
  switch (arm) {
    case Arm::rigid:
    case Arm::welded:
      return "arm";
    case Arm::beam_2:
    case Arm::beam_3:
      return "arm/start";
    default:
      return "arm/n0";
  }
}

std::string tip_node(Arm arm) {
  switch (arm) {
    case Arm::rigid:
      return "arm/tip";
    case Arm::welded:
      return "hub/tip";
    case Arm::beam_2:
    case Arm::beam_3:
      return "arm/end";
    case Arm::second_order:
      return "arm/n4";
    default:
      return "arm/n5";
  }
}

const mechanism::BodyFiles& arm_files() {
  static const mechanism::BodyFiles files = made_files();
  return files;
}

}  // namespace tisserand::test_support::crossings

// SPDX-License-Identifier: GPL-3.0-or-later
// The similarities of changes, and those that change no number.
#include "tests/support/crossings/changes.hpp"

#include <algorithm>
#include <array>
#include <variant>
#include <vector>

#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support::crossings {

using Eigen::Vector3d;

namespace {

Eigen::Matrix3d turn() { return Eigen::AngleAxisd(2.1, Vector3d(0.3, -0.7, 0.5).normalized()).toRotationMatrix(); }
Eigen::Matrix3d mirror() {
  const Vector3d n = Vector3d(0.5, 0.2, -0.9).normalized();
  return Eigen::Matrix3d::Identity() - 2.0 * n * n.transpose();
}
void set_units(Similarity& s) {
  s.length = 1e3;
  s.mass = 1e-3;
  s.time = 1e3;
  s.units = {length_unit("mm"), mass_unit("t"), time_unit("ms")};
}

void reorder(formats::Scene& scene) {
  std::reverse(scene.bodies.begin(), scene.bodies.end());
  std::reverse(scene.joints.begin(), scene.joints.end());
  std::reverse(scene.springs.begin(), scene.springs.end());
  std::reverse(scene.bushings.begin(), scene.bushings.end());
  std::reverse(scene.loads.begin(), scene.loads.end());
  std::reverse(scene.channels.begin(), scene.channels.end());
}

/// Held where the analysis needs it: a body that falls has no equilibrium.
void add_bystander(formats::Scene& scene) {
  formats::RigidBodySpec body = rigid_body("bystander", 0.7, {0.1, 0, 0}, {0.01, 0.02, 0.025});
  body.start.pose.position = {-0.8, 0.9, 0.4};
  if (scene.analysis == formats::AnalysisKind::dynamics) {
    body.start.velocity = Vector3d(0.1, 0, 0.2);
    body.start.angular_velocity = Vector3d(1, 0.5, 0);
  } else {
    formats::JointSpec held =
        joint("held", formats::JointKind::fixed, "ground", "bystander", body.start.pose.position, Vector3d::UnitZ());
    held.x_axis = Vector3d::UnitX();
    scene.joints.push_back(held);
  }
  scene.bodies.emplace_back(body);
}

/// Part frames that stand elsewhere in their bodies: B = A C with one pose C for all. Markers on the body itself keep
/// their places.
struct OtherFrame {
  Eigen::Matrix3d R = Eigen::AngleAxisd(1.3, Vector3d(0.2, 0.9, -0.4).normalized()).toRotationMatrix();
  Vector3d p{0.3, -0.1, 0.2};
  Vector3d place(const Vector3d& x) const { return R.transpose() * (x - p); }

  void start(formats::InitialMotion& motion) const {
    const Eigen::Quaterniond q = motion.pose.orientation;
    const Vector3d arm = q * p;
    motion.pose = {motion.pose.position + arm, (q * Eigen::Quaterniond(R)).normalized()};
    if (motion.velocity && motion.angular_velocity) *motion.velocity += motion.angular_velocity->cross(arm);
  }
  void nodes(std::vector<formats::RigidNodeSpec>& list) const {
    for (formats::RigidNodeSpec& node : list)
      node.pose = {place(node.pose.position),
                   Eigen::Quaterniond(Eigen::Matrix3d(R.transpose() * node.pose.orientation)).normalized()};
  }
  /// The former part frame becomes a node that markers on the body name.
  void add_origin(std::vector<formats::RigidNodeSpec>& list) const {
    list.push_back({"origin", {place(Vector3d::Zero()), Eigen::Quaterniond(Eigen::Matrix3d(R.transpose()))}});
  }
};

void name_origin(formats::Scene& scene, const std::string& body) {
  const auto rename = [&](formats::MarkerSpec& marker) {
    if (marker.node == body) marker.node += "/origin";
  };
  const auto both = [&](formats::MarkerPairSpec& pair) {
    rename(pair.a);
    rename(pair.b);
  };
  for (formats::JointSpec& joint : scene.joints) both(joint);
  for (formats::SpringSpec& spring : scene.springs) both(spring);
  for (formats::BushingSpec& bushing : scene.bushings) both(bushing);
  for (formats::LoadSpec& load : scene.loads) rename(load.at);
  for (formats::ChannelSpec& channel : scene.channels) {
    rename(channel.a);
    rename(channel.b);
  }
}

void move_part_frames(formats::Scene& scene) {
  const OtherFrame other;
  for (formats::BodySpec& body : scene.bodies) {
    if (auto* rigid = std::get_if<formats::RigidBodySpec>(&body)) {
      other.start(rigid->start);
      rigid->center_of_mass = other.place(rigid->center_of_mass);
      rigid->inertia = other.R.transpose() * rigid->inertia * other.R;
      rigid->inertia = (0.5 * (rigid->inertia + rigid->inertia.transpose())).eval();
      other.nodes(rigid->nodes);
      other.add_origin(rigid->nodes);
      name_origin(scene, rigid->name);
    } else if (auto* hub = std::get_if<formats::VirtualBodySpec>(&body)) {
      other.start(hub->start);
      other.nodes(hub->nodes);
      other.add_origin(hub->nodes);
      name_origin(scene, hub->name);
    }
  }
}

}  // namespace

std::string name_of(Change change) {
  static constexpr std::array<const char*, changes> names{"turned",  "mirrored", "units",     "far",
                                                          "delayed", "together", "reordered", "bystander",
                                                          "dense",   "umfpack",  "kept",      "part_frame"};
  return names[static_cast<int>(change)];
}

Similarity similarity_of(Change change) {
  Similarity s;
  switch (change) {
    case Change::turned:
      s.Q = turn();
      break;
    case Change::mirrored:
      s.Q = mirror();
      break;
    case Change::units:
      set_units(s);
      break;
    case Change::far:
      s.shift = {600, -500, 700};
      break;
    case Change::delayed:
      s.delay = 10.0;
      break;
    case Change::together:
      set_units(s);
      s.Q = turn() * mirror();
      s.shift = {7e3, -3e3, 4e3};
      s.delay = 2e3;
      break;
    case Change::reordered:
    case Change::bystander:
    case Change::dense:
    case Change::umfpack:
    case Change::kept:
    case Change::part_frame:
      break;
  }
  return s;
}

formats::Scene changed(const formats::Scene& before, Change change) {
  formats::Scene scene = described(before, similarity_of(change));
  if (change == Change::reordered) reorder(scene);
  if (change == Change::bystander) add_bystander(scene);
  if (change == Change::dense) scene.integrator.linear_solver = formats::LinearSolver::dense;
  if (change == Change::umfpack) scene.integrator.linear_solver = formats::LinearSolver::umfpack;
  if (change == Change::kept) scene.virtual_bodies = formats::VirtualBodies::keep;
  if (change == Change::part_frame) move_part_frames(scene);
  return scene;
}

}  // namespace tisserand::test_support::crossings

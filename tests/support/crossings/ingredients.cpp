// SPDX-License-Identifier: GPL-3.0-or-later
// Assembly of the scenes of cells: hinge, bob, start, scheme.
#include "tests/support/crossings/ingredients.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "mechanism/bdf/bdf.hpp"
#include "tests/support/crossings/actions.hpp"
#include "tests/support/crossings/arms.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support::crossings {

using Eigen::Vector3d;
using formats::JointKind;
using formats::Scene;

namespace {

/// Velocity of the root and angular velocity that the hinge allows, axes x, y, z of the hinge.
struct FreeMotion {
  Vector3d velocity, angular_velocity;
};

FreeMotion free_motion(Hinge hinge) {
  switch (hinge) {
    case Hinge::fixed:
      return {{0, 0, 0}, {0, 0, 0}};
    case Hinge::revolute:
      return {{0, 0, 0}, {0, 0, 1.5}};
    case Hinge::spherical:
      return {{0, 0, 0}, {0.7, -0.5, 1.1}};
    case Hinge::universal:
    case Hinge::constant_velocity:
      return {{0, 0, 0}, {1.2, 0, 0}};
    case Hinge::cylindrical:
      return {{0, 0, 0.4}, {0, 0, 1.5}};
    case Hinge::screw:
      return {{0, 0, 0.2 * 1.5 / (2.0 * std::numbers::pi)}, {0, 0, 1.5}};
    case Hinge::prismatic:
      return {{0, 0, 0.5}, {0, 0, 0}};
    case Hinge::planar:
      return {{0.3, -0.2, 0}, {0, 0, 1.2}};
    case Hinge::point_on_line:
      return {{0, 0, 0.4}, {0.5, 0.6, -0.7}};
    case Hinge::point_on_plane:
    case Hinge::distance:
      return {{0.4, 0.3, 0}, {0.5, 0.6, -0.7}};
    case Hinge::constant_orientation:
      return {{0.4, 0.3, -0.2}, {0, 0, 0}};
    case Hinge::parallel_axes:
      return {{0.4, 0.3, -0.2}, {0, 0, 1.2}};
    case Hinge::generic:
      return {{0, 0.4, 0}, {0, 0, 1.2}};
    case Hinge::none:
      break;
  }
  return {{0.4, 0.3, -0.2}, {0.5, 0.6, -0.7}};
}

/// Their order in the enums is the same, but for `none` before the joints.
/// Hinges are `none` and the kinds of joints in their order.
static_assert(static_cast<int>(Hinge::generic) - 1 == static_cast<int>(JointKind::generic) &&
              hinges == static_cast<int>(Hinge::generic) + 1);
JointKind kind_of(Hinge hinge) { return static_cast<JointKind>(static_cast<int>(hinge) - 1); }

void add_hinge(const Ingredients& in, Scene& scene) {
  if (in.hinge == Hinge::none) return;
  formats::JointSpec hinge = joint("hinge", kind_of(in.hinge), "ground", root_node(in.arm), root_place(), hinge_axis());
  hinge.x_axis = hinge_x_axis();
  if (in.hinge == Hinge::screw) hinge.pitch = 0.2;
  if (in.hinge == Hinge::generic) hinge.hold = {true, false, true, true, true, false};
  if (in.hinge == Hinge::distance) {
    hinge.position.reset();
    hinge.axis.reset();
    hinge.x_axis.reset();
    hinge.a.position = root_place() + 0.4 * hinge_axis();
  }
  scene.joints.push_back(hinge);
}

void add_bob(const Ingredients& in, Scene& scene) {
  formats::RigidBodySpec bob;
  bob.name = "bob";
  bob.mass = 0.5;
  bob.center_of_mass = {0.05, 0.1, -0.02};
  bob.inertia = turned_inertia({0.02, 0.03, 0.04});
  const Eigen::Quaterniond askew(Eigen::AngleAxisd(1.1, Vector3d(1, 0.2, -0.4).normalized()));
  bob.nodes = {{"hook", {{0.1, -0.15, 0.2}, askew}}};
  bob.start.pose = {tip_place(in.arm), askew};
  scene.bodies.emplace_back(bob);
  formats::JointSpec wrist = joint("wrist", JointKind::revolute, tip_node(in.arm), "bob", tip_place(in.arm),
                                   Vector3d(0.4, -0.8, 0.5).normalized());
  wrist.x_axis = Vector3d(1, 0.3, 0.2);
  scene.joints.push_back(wrist);
}

/// Tight enough that what remains of Newton's iteration is far below what cells allow.
void set_scheme(Scheme scheme, formats::IntegratorSpec& i) {
  i.tolerance = 1e-11;
  i.constraint_tolerance = 1e-13;
  if (scheme == Scheme::index_3 || scheme == Scheme::controlled_index_3) i.formulation = formats::Formulation::index3;
  if (scheme == Scheme::damped) i.rho = 0.0;
  if (scheme == Scheme::hht) i.method = formats::Method::hht;
  if (scheme == Scheme::radau || scheme == Scheme::controlled_radau) i.method = formats::Method::radau;
  if (scheme == Scheme::bdf) {
    i.method = formats::Method::bdf;
    i.bdf.relative_tolerance = 1e-9;
    i.bdf.absolute_tolerance = 1e-10;
  }
  if (scheme == Scheme::controlled || scheme == Scheme::controlled_index_3) i.error_control = {true, 1e-3};
  if (scheme == Scheme::controlled_radau) i.error_control = {true, 1e-7};
}

Scene bare_scene(const Ingredients& in) {
  Scene scene = empty_scene(2e-3, 0.12);
  scene.output.interval = 0.012;
  scene.gravity = {0.4, -0.7, -1.9};
  set_scheme(in.scheme, scene.integrator);
  add_arm(in.arm, scene);
  add_hinge(in, scene);
  add_bob(in, scene);
  return scene;
}

/// Soft in all directions, about the tip and the wrist.
void hold(const Ingredients& in, Scene& scene) {
  formats::BushingSpec mount;
  mount.name = "mount";
  mount.a = {"ground", root_place() + Vector3d(0.1, 0.2, -0.1), {}, ""};
  mount.b = {root_node(in.arm), {}, {}, ""};
  mount.axis = hinge_axis();
  mount.x_axis = hinge_x_axis();
  mount.stiffness.diagonal() << 200, 260, 230, 90, 80, 70;
  mount.damping.diagonal() << 2, 1, 3, 0.2, 0.1, 0.3;
  scene.bushings.push_back(mount);
  formats::SpringSpec spring;
  spring.name = "wrist_spring";
  spring.coordinate = formats::CoordinateRef{"wrist", ""};
  spring.stiffness = 8.0;
  spring.damping = 0.05;
  scene.springs.push_back(spring);
}

/// Whether velocities at the start follow from what acts.
bool follows(Action action) {
  return action == Action::drive || action == Action::gear || action == Action::tether ||
         action == Action::initial_value;
}

template <std::size_t n>
std::string listed(const std::array<const char*, n>& names, int k) {
  return names[k];
}

}  // namespace

Scene dynamics_scene(const Ingredients& in) {
  Scene scene = bare_scene(in);
  if (!follows(in.action)) {
    const FreeMotion motion = free_motion(in.hinge);
    Eigen::Matrix3d axes;
    axes.col(2) = hinge_axis();
    axes.col(1) = hinge_axis().cross(hinge_x_axis()).normalized();
    axes.col(0) = axes.col(1).cross(axes.col(2));
    const Vector3d velocity = axes * motion.velocity, angular_velocity = axes * motion.angular_velocity;
    for (formats::BodySpec& body : scene.bodies)
      std::visit(
          [&](auto& spec) {
            const Vector3d arm = spec.start.pose.position - root_place();
            spec.start.velocity = Vector3d(velocity + angular_velocity.cross(arm));
            spec.start.angular_velocity = angular_velocity;
          },
          body);
  }
  add_action(in, scene);
  return scene;
}

std::string refusal_of(const Ingredients& in) {
  const bool radau = in.scheme == Scheme::radau || in.scheme == Scheme::controlled_radau;
  if (in.arm == Arm::second_order && radau) return "method radau needs linear superelements";
  if (in.scheme == Scheme::bdf && !mechanism::bdf_available()) return "this build has no CVODE";
  return "";
}

bool is_sensible(const Ingredients& in) {
  if (in.action == Action::initial_value) switch (in.hinge) {
      case Hinge::none:
      case Hinge::spherical:
      case Hinge::constant_velocity:
      case Hinge::point_on_line:
      case Hinge::point_on_plane:
      case Hinge::distance:
        return false;
      default:
        break;
    }
  return in.action != Action::part_load || in.arm == Arm::second_order;
}

Scene held_scene(const Ingredients& in) {
  Scene scene = bare_scene(in);
  hold(in, scene);
  add_action(in, scene);
  scene.analysis = formats::AnalysisKind::statics;
  scene.statics.load_steps = 3;
  scene.statics.tolerance = 1e-11;
  return scene;
}

Vector3d root_place() { return {0.3, -0.2, 0.1}; }
Vector3d tip_place(Arm arm) { return root_place() + arm_orientation() * tip_in_part(arm); }
Vector3d hinge_axis() { return Vector3d(0.3, 0.5, -0.8).normalized(); }
Vector3d hinge_x_axis() { return {0.9, -0.2, 0.4}; }

std::vector<std::string> coordinates_of(Hinge hinge) {
  if (hinge == Hinge::none) return {};
  if (hinge == Hinge::generic) return {"hinge/y", "hinge/angle"};
  const formats::CoordinateNames& names = formats::joint_kind(kind_of(hinge)).coordinates;
  if (names.count == 1) return {"hinge"};
  std::vector<std::string> all;
  for (const std::string_view name : names) all.push_back("hinge/" + std::string(name));
  return all;
}

std::string name_of(Arm arm) {
  return listed<arms>({"rigid", "use_rigid", "welded", "beam_2", "beam_3", "karcher_B", "node_A", "paper_B",
                       "weighted_M", "second_order", "modal", "mixed", "automatic"},
                      static_cast<int>(arm));
}
std::string name_of(Hinge hinge) { return hinge == Hinge::none ? "none" : formats::joint_word(kind_of(hinge)); }
std::string name_of(Action action) {
  return listed<actions>({"nothing", "world_loads", "following_loads", "line_spring", "torsion_spring", "bushing",
                          "unsymmetric_bushing", "channels", "drive", "stop", "friction", "gear", "own_gravity",
                          "tables", "tether", "second_hinge", "initial_value", "part_load"},
                         static_cast<int>(action));
}
std::string name_of(Scheme scheme) {
  return listed<schemes>(
      {"index_2", "index_3", "damped", "hht", "radau", "bdf", "controlled", "controlled_index_3", "controlled_radau"},
      static_cast<int>(scheme));
}

}  // namespace tisserand::test_support::crossings

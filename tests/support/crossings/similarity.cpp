// SPDX-License-Identifier: GPL-3.0-or-later
// What each entry of a scene becomes: points, vectors, axial vectors, tensors, laws and functions of time.
#include "tests/support/crossings/similarity.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "tests/support/crossings/functions.hpp"

namespace tisserand::test_support::crossings {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using formats::Scene;

namespace {

/// Descriptions of the entries of one scene.
struct Describer {
  const Scene& scene;
  const Similarity& s;

  Vector3d vector(const Vector3d& v) const { return s.Q * v; }
  Vector3d axial(const Vector3d& v) const { return s.sign() * (s.Q * v); }
  double acceleration() const { return s.length / (s.time * s.time); }

  void start(formats::InitialMotion& motion) const {
    motion.pose.position = s.point(motion.pose.position);
    motion.pose.orientation = Eigen::Quaterniond(s.rotation(motion.pose.orientation.toRotationMatrix())).normalized();
    velocities(motion.velocity, motion.angular_velocity);
  }
  void velocities(std::optional<Vector3d>& velocity, std::optional<Vector3d>& angular) const {
    if (velocity) *velocity = vector(*velocity) * (s.length / s.time);
    if (angular) *angular = axial(*angular) / s.time;
  }
  void gravity(std::optional<Vector3d>& g) const {
    if (g) *g = vector(*g) * acceleration();
  }
  void nodes(std::vector<formats::RigidNodeSpec>& list) const {
    for (formats::RigidNodeSpec& node : list) {
      node.pose.position = s.length * (s.parts() * node.pose.position);
      node.pose.orientation =
          Eigen::Quaterniond(Matrix3d(s.parts() * node.pose.orientation.toRotationMatrix() * s.parts())).normalized();
    }
  }
  void damping(formats::Damping& d) const {
    d.mass /= s.time;
    d.stiffness *= s.time;
  }
  void body(formats::RigidBodySpec& b) const {
    b.mass *= s.mass;
    b.center_of_mass = s.length * (s.parts() * b.center_of_mass);
    b.inertia = s.mass * s.length * s.length * (s.parts() * b.inertia * s.parts());
    nodes(b.nodes);
    gravity(b.gravity);
  }
  void body(formats::VirtualBodySpec& b) const { nodes(b.nodes); }
  void body(formats::SuperelementBodySpec& b) const {
    b.mirror = s.parts() * b.mirror;
    damping(b.damping);
    gravity(b.gravity);
  }
  void body(formats::ModalBodySpec& b) const {
    b.mirror = s.parts() * b.mirror;
    damping(b.damping);
    gravity(b.gravity);
  }
  void body(formats::BeamBodySpec& b) const {
    for (Vector3d* p : {&b.from, &b.to}) *p = s.length * (s.parts() * *p);
    if (b.through) b.through = Vector3d(s.length * (s.parts() * *b.through));
    if (b.orientation) b.orientation = Vector3d(s.parts() * *b.orientation);
    formats::Section& section = b.section;
    if (!section.by_stiffness) throw std::logic_error("sections by stiffness alone");
    for (double* force : {&section.area, &section.shear_area_y, &section.shear_area_z}) *force *= s.force();
    for (double* bending :
         {&section.second_moment_y, &section.second_moment_z, &section.torsion_constant, &section.polar_moment})
      *bending *= s.force() * s.length * s.length;
    section.mass_per_length *= s.mass / s.length;
    section.rotary_inertia_y *= s.mass * s.length;
    section.rotary_inertia_z *= s.mass * s.length;
    gravity(b.gravity);
  }

  void marker(formats::MarkerSpec& m) const {
    const bool ground = m.node == "ground";
    if (m.position) m.position = ground ? s.point(*m.position) : Vector3d(s.length * (s.parts() * *m.position));
    if (!m.orientation) return;
    const Matrix3d R = m.orientation->toRotationMatrix();
    m.orientation = Eigen::Quaterniond(Matrix3d((ground ? s.Q : s.parts()) * R * s.markers())).normalized();
  }
  void pair(formats::MarkerPairSpec& p) const {
    marker(p.a);
    marker(p.b);
    if (p.position) p.position = s.point(*p.position);
    if (p.axis) p.axis = vector(*p.axis);
    if (p.x_axis) p.x_axis = vector(*p.x_axis);
  }
  void joint(formats::JointSpec& j) const {
    pair(j);
    j.pitch *= s.sign() * s.length;
    if (j.length) *j.length *= s.length;
    if (!j.friction) return;
    j.friction->velocity *= s.length / s.time;
    j.friction->radius *= s.length;
    if (j.friction->arm) *j.friction->arm *= s.length;
  }
  /// What acts along a coordinate of this factor: force or moment.
  double along(const Factor& f) const { return s.energy() / f.scale; }

  void spring(formats::SpringSpec& spring) const {
    const Factor f = spring_factor(scene, spring, s);
    pair(spring);
    const double rate = along(f) / f.scale;
    spring.stiffness = law(spring.stiffness, f.whole(), f.sign * along(f));
    spring.damping = law(spring.damping, f.whole() / s.time, f.sign * along(f));
    if (spring.free) *spring.free *= f.whole();
    if (spring.lower) *spring.lower *= f.whole();
    if (spring.upper) *spring.upper *= f.whole();
    if (f.sign < 0.0) std::swap(spring.lower, spring.upper);
    spring.stop_stiffness *= rate;
    spring.stop_damping *= s.time / f.scale;
    if (spring.force) spring.force = function(*spring.force, f.sign * along(f));
  }
  void bushing(formats::BushingSpec& b) const {
    pair(b);
    Eigen::Matrix<double, 6, 1> moves, acts;
    const double e = s.sign();
    moves << s.length, e * s.length, s.length, e, 1.0, e;
    acts << s.force(), e * s.force(), s.force(), e * s.energy(), s.energy(), e * s.energy();
    const Eigen::Matrix<double, 6, 1> back = moves.cwiseInverse();
    b.stiffness = acts.asDiagonal() * b.stiffness * back.asDiagonal();
    b.damping = s.time * (acts.asDiagonal() * b.damping * back.asDiagonal());
    if (b.free) *b.free = moves.cwiseProduct(*b.free);
    b.preload = acts.cwiseProduct(b.preload);
  }
  void load(formats::LoadSpec& l) const {
    const Matrix3d axes = body_axes_of(l, s);
    marker(l.at);
    const bool force = l.kind == formats::LoadKind::force;
    const double scale = force ? s.force() : s.sign() * s.energy();
    if (l.axes == formats::LoadAxes::world) {
      l.components = combined(l.components, scale * s.Q, scene, s);
      return;
    }
    for (int i = 0; i < 3; ++i) l.components[i] = function(l.components[i], scale * axes(i, i));
  }
  void channel(formats::ChannelSpec& c) const {
    marker(c.a);
    marker(c.b);
    c.axis = vector(c.axis);
    c.origin = s.point(c.origin);
  }
  formats::TimeFunctionSpec function(const formats::TimeFunctionSpec& f, double factor) const {
    return rewritten(f, factor, scene, s);
  }
};

void settings(Scene& scene, const Similarity& s) {
  formats::IntegratorSpec& i = scene.integrator;
  i.step *= s.time;
  i.start = i.start * s.time + s.delay;
  i.end = i.end * s.time + s.delay;
  i.error_control.min_step *= s.time;
  i.error_control.max_step *= s.time;
  if (scene.output.interval) *scene.output.interval *= s.time;
  scene.output.from = i.start;
  if (scene.statics.rotation) {
    formats::RotationSpec& turn = *scene.statics.rotation;
    turn.angular_velocity = s.sign() * (s.Q * turn.angular_velocity) / s.time;
    turn.about = s.point(turn.about);
  }
  if (scene.modes.rotation) scene.modes.rotation = Vector3d(s.sign() * (s.Q * *scene.modes.rotation) / s.time);
}

}  // namespace

Factor coordinate_factor(const Scene& scene, const std::string& coordinate, const Similarity& s) {
  const std::size_t slash = coordinate.find('/');
  const std::string name = coordinate.substr(0, slash);
  for (const formats::SpringSpec& spring : scene.springs)
    if (spring.name == name) return spring_factor(scene, spring, s);
  for (const formats::ChannelSpec& channel : scene.channels)  // distances are coordinates too
    if (channel.name == name) return {1.0, s.length};
  const auto joint =
      std::find_if(scene.joints.begin(), scene.joints.end(), [&](const auto& j) { return j.name == name; });
  if (joint == scene.joints.end()) throw std::logic_error("no joint " + name);
  const std::string which = slash == std::string::npos
                                ? std::string(*formats::joint_kind(joint->kind).coordinates.begin())
                                : coordinate.substr(slash + 1);
  if (which == "angle_y") return {};
  if (which.starts_with("angle")) return {s.sign(), 1.0};
  return {which == "y" ? s.sign() : 1.0, s.length};
}

Factor spring_factor(const Scene& scene, const formats::SpringSpec& spring, const Similarity& s) {
  if (spring.coordinate) return coordinate_factor(scene, spring.coordinate->name, s);
  if (spring.kind == formats::SpringKind::torsion) return {s.sign(), 1.0};
  return {1.0, s.length};
}

Matrix3d body_axes_of(const formats::LoadSpec& load, const Similarity& s) {
  return load.at.orientation ? s.markers() : s.parts();
}

Scene described(const Scene& before, const Similarity& s) {
  Scene scene = before;
  const Describer d{before, s};
  scene.units = s.units;
  scene.gravity = s.Q * before.gravity * d.acceleration();
  for (formats::BodySpec& body : scene.bodies)
    std::visit(
        [&](auto& spec) {
          d.start(spec.start);
          d.body(spec);
        },
        body);
  for (formats::JointSpec& joint : scene.joints) d.joint(joint);
  for (formats::GearSpec& gear : scene.gears)
    gear.ratio *=
        coordinate_factor(before, gear.second.name, s).whole() / coordinate_factor(before, gear.first.name, s).whole();
  for (formats::InputSpec& input : scene.inputs)
    for (double& t : input.table.time) t = s.time * t + s.delay;
  for (formats::ChannelSpec& channel : scene.channels) d.channel(channel);
  for (formats::MotionSpec& motion : scene.motions)
    motion.value = d.function(motion.value, coordinate_factor(before, motion.coordinate.name, s).whole());
  for (formats::InitialSpec& initial : scene.initial) {
    d.velocities(initial.velocity, initial.angular_velocity);
    if (initial.of_body()) continue;
    const double factor = coordinate_factor(before, initial.coordinate.name, s).whole();
    if (initial.value) *initial.value *= factor;
    if (initial.rate) *initial.rate *= factor / s.time;
  }
  for (formats::SpringSpec& spring : scene.springs) d.spring(spring);
  for (formats::BushingSpec& bushing : scene.bushings) d.bushing(bushing);
  for (formats::LoadSpec& load : scene.loads) d.load(load);
  for (formats::PartLoadSpec& load : scene.part_loads) load.value = d.function(load.value, 1.0);
  settings(scene, s);
  return scene;
}

}  // namespace tisserand::test_support::crossings

// SPDX-License-Identifier: GPL-3.0-or-later
// Joints between markers, their coordinates, and the elements that act along these.
#include "mechanism/build/joints.hpp"

#include <numbers>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {

using Eigen::Vector3d;

void JointBuilder::check_markers(const formats::JointSpec& spec, const Joint& joint) const {
  const std::string subject = fmt::format("joint '{}'", spec.name);
  const Dependence needs = depends_on(joint);
  const bool other_way_round = !needs.axes_b && has_rotation(model_, joint.b.node);
  check_marker(model_, subject, {needs.places, needs.axes_a, other_way_round}, spec.a, joint.a);
  check_marker(model_, subject, {needs.places, needs.axes_b}, spec.b, joint.b);
}

void JointBuilder::add(const formats::JointSpec& spec) {
  Joint joint;
  joint.name = spec.name;
  joint.a = markers_.find(spec.a);
  joint.b = markers_.find(spec.b);
  set_relations(spec.kind, spec.hold, joint);
  if (joint.a.node == joint.b.node)
    throw Error(fmt::format("joint '{}' connects '{}' and '{}', which are {}", spec.name, spec.a.node, spec.b.node,
                            joint.a.node < 0 ? "both ground" : "on the same node"),
                spec.where,
                joint.a.follower < 0 && joint.b.follower < 0
                    ? "connect two different nodes"
                    : "fixed joints already connect these bodies: remove this joint, or one of the fixed joints");
  if (formats::joint_kind(spec.kind).axes == formats::JointAxes::required && !spec.axis && !spec.a.orientation &&
      !spec.b.orientation)
    throw Error(fmt::format("{} joint '{}' has no axis", formats::joint_word(spec.kind), spec.name), spec.where,
                "give `axis: [x, y, z]` in the world frame at the start, or orientations of its markers");
  if (!keeps_distance(joint)) place_markers(markers_, spec, joint.a, joint.b);
  check_markers(spec, joint);
  add_rigid_arms(markers_, spec, joint, model_.length, arms_);
  if (keeps_distance(joint)) set_length(spec, joint);
  add_coordinates(joint);
  if (joint_law(spec.kind).threaded) joint.thread = add_thread(spec);
  if (spec.friction) add_friction(spec);
  model_.joints.push_back(std::move(joint));
}

void JointBuilder::set_length(const formats::JointSpec& spec, Joint& joint) const {
  const double start = distance_at_start(joint.a, joint.b);
  joint.constant = spec.length.value_or(start);
  // Assembly can reach a given length from coincident markers.
  if (!spec.length && !(start > 1e-9 * model_.length))
    throw Error(
        fmt::format("joint '{}' keeps the distance between two markers, but both are at the same place", spec.name),
        spec.where, "use a spherical joint, give the markers different positions, or give the joint a length");
}

double JointBuilder::distance_at_start(const Marker& a, const Marker& b) const {
  return (markers_.position(b) - markers_.position(a)).norm();
}

void JointBuilder::add_coordinates(const Joint& joint) {
  std::vector<NamedRelation> all = free_coordinates(joint);
  if (!has_translation(model_, joint.a.node) || !has_translation(model_, joint.b.node))
    std::erase_if(all, [](const NamedRelation& free) { return depends_on(free.relation).places; });
  for (const NamedRelation& free : all) {
    Coordinate coordinate;
    coordinate.name = all.size() == 1 ? joint.name : joint.name + "/" + free.name;
    coordinate.a = joint.a;
    coordinate.b = joint.b;
    coordinate.relation = free.relation;
    coordinate_[joint.name + "/" + free.name] = count_of(model_.coordinates);
    if (all.size() == 1) coordinate_[joint.name] = count_of(model_.coordinates);
    model_.coordinates.push_back(std::move(coordinate));
  }
}

void JointBuilder::add_friction(const formats::JointSpec& joint) {
  const formats::FrictionSpec& spec = *joint.friction;
  Friction friction;
  friction.joint = count_of(model_.joints);
  friction.kinetic = spec.coefficient;
  friction.stiction = spec.static_coefficient.value_or(spec.coefficient);
  friction.velocity = spec.velocity;
  friction.radius = spec.radius;
  friction.inverse_arm = spec.arm ? 1.0 / *spec.arm : 0.0;
  if (joint_law(joint.kind).threaded) {
    friction.thread = count_of(model_.couplings) - 1;
    friction.lead = joint.pitch / (2.0 * std::numbers::pi);
  }
  model_.frictions.push_back(friction);
}

int JointBuilder::add_thread(const formats::JointSpec& spec) {
  Coupling thread;
  thread.name = spec.name + ", advance with the rotation";
  thread.length = true;
  thread.thread = true;
  thread.from_start = true;
  const int angle = coordinate_.at(spec.name + "/angle"), z = coordinate_.at(spec.name + "/z");
  thread.terms = {{z, 1.0}, {angle, static_cast<double>(-spec.pitch / (2.0 * std::numbers::pi))}};
  activate(thread);
  return count_of(model_.couplings) - 1;
}

void JointBuilder::activate(Coupling& coupling) {
  for (const CouplingTerm& term : coupling.terms) model_.coordinates[term.coordinate].active = true;
  model_.couplings.push_back(std::move(coupling));
}

int JointBuilder::find_coordinate(const formats::CoordinateRef& ref) const {
  const auto found = coordinate_.find(ref.name);
  if (found != coordinate_.end()) return found->second;
  std::vector<std::string> of_joint, all;
  const std::string joint = ref.name.substr(0, ref.name.rfind('/'));
  for (const auto& [name, index] : coordinate_) {
    all.push_back(name);
    if (name.starts_with(joint + "/")) of_joint.push_back(name);
  }
  throw Error(fmt::format("there is no joint coordinate '{}'", ref.name), ref.where,
              !of_joint.empty() ? fmt::format("joint '{}' has {}", joint, listed(of_joint))
                                : "coordinates of this scene: " + (all.empty() ? "none" : listed(all)));
}

CoordinateStart JointBuilder::initial(const formats::InitialSpec& spec) const {
  return {spec.coordinate.name, find_coordinate(spec.coordinate), spec.value, spec.rate};
}

bool JointBuilder::is_length_coordinate(int coordinate) const {
  return is_length(model_.coordinates[coordinate].relation);
}

void JointBuilder::add(const formats::GearSpec& spec) {
  Coupling gear;
  gear.name = spec.name;
  gear.from_start = true;
  const int first = find_coordinate(spec.first), second = find_coordinate(spec.second);
  if (first == second)
    throw Error(fmt::format("joint '{}' couples '{}' to itself", spec.name, spec.first.name), spec.where,
                "name two different coordinates");
  gear.length = is_length_coordinate(second);
  gear.terms = {{second, 1.0}, {first, -spec.ratio}};
  activate(gear);
}

void JointBuilder::add(const formats::MotionSpec& spec) {
  Coupling motion;
  motion.name = fmt::format("motion {}", spec.name);
  const int coordinate = find_coordinate(spec.coordinate);
  motion.length = is_length_coordinate(coordinate);
  motion.terms = {{coordinate, 1.0}};
  motion.motion = count_of(model_.motions);
  const TimeFunction function(spec.value, model_.scope);  // reports syntax errors
  if (!function.channels().empty())
    throw Error(
        fmt::format("motion '{}' uses channel '{}'", spec.name, model_.scope.channels[function.channels().front()]),
        spec.where, "write the motion as a function of t and inputs; only forces may use channels");
  breakpoints_.insert(function.breakpoints().begin(), function.breakpoints().end());
  model_.motions.push_back(spec.value);
  activate(motion);
}

}  // namespace tisserand::mechanism

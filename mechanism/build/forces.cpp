// SPDX-License-Identifier: GPL-3.0-or-later
// Springs, bushings, inputs and channels between the markers of a scene.
#include <algorithm>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/scene/expand/expression.hpp"
#include "mechanism/build/joints.hpp"

namespace tisserand::mechanism {

void JointBuilder::add(const formats::SpringSpec& spec) {
  Spring spring;
  spring.name = spec.name;
  spring.coordinate = spec.coordinate ? find_coordinate(*spec.coordinate)
                      : spec.kind == formats::SpringKind::torsion
                          ? add_angle(spec)
                          : add_distance(spec.name, fmt::format("spring '{}'", spec.name), spec, spec.where);
  model_.coordinates[spring.coordinate].active = true;
  spring.stiffness = Curve(spec.stiffness);
  spring.damping = Curve(spec.damping);
  spring.free = spec.free.value_or(0.0);
  spring.free_at_start = !spec.free;
  spring.lower = spec.lower;
  spring.upper = spec.upper;
  spring.stop_stiffness = spec.stop_stiffness;
  spring.stop_damping = spec.stop_damping;
  spring.has_force = spec.force.has_value();
  if (spec.force) {
    spring.force = *spec.force;
    note_function(spring.force, {ChannelUse::Owner::spring, count_of(model_.springs), 0, 0, 0}, model_, breakpoints_);
  }
  model_.springs.push_back(std::move(spring));
}

int JointBuilder::add_distance(const std::string& name, const std::string& subject, const formats::MarkerPairSpec& spec,
                               const std::string& where) {
  Coordinate coordinate;
  coordinate.name = name;
  coordinate.a = markers_.find(spec.a);
  coordinate.b = markers_.find(spec.b);
  coordinate.relation = {RelationKind::distance, 0, 0};
  require_two_nodes(subject, spec, where, coordinate.a, coordinate.b);
  check_marker(model_, subject, use_position, spec.a, coordinate.a);
  check_marker(model_, subject, use_position, spec.b, coordinate.b);
  if (!(distance_at_start(coordinate.a, coordinate.b) > 1e-9 * model_.length))
    throw Error(fmt::format("{} has no direction: its ends are at the same place", subject), where,
                "move one end, or use the coordinates of a joint");
  model_.coordinates.push_back(std::move(coordinate));
  return count_of(model_.coordinates) - 1;
}

int JointBuilder::add_angle(const formats::SpringSpec& spec) {
  Coordinate coordinate;
  coordinate.name = spec.name;
  coordinate.a = markers_.find(spec.a);
  coordinate.b = markers_.find(spec.b);
  coordinate.relation = {RelationKind::angle, 2, 0};
  const std::string subject = fmt::format("spring '{}'", spec.name);
  require_two_nodes(subject, spec, spec.where, coordinate.a, coordinate.b);
  place_markers(markers_, spec, coordinate.a, coordinate.b);
  check_marker(model_, subject, use_axes, spec.a, coordinate.a);
  check_marker(model_, subject, use_axes, spec.b, coordinate.b);
  model_.coordinates.push_back(std::move(coordinate));
  return count_of(model_.coordinates) - 1;
}

void JointBuilder::add(const formats::BushingSpec& spec) {
  Bushing bushing;
  bushing.name = spec.name;
  bushing.a = markers_.find(spec.a);
  bushing.b = markers_.find(spec.b);
  const std::string subject = fmt::format("bushing '{}'", spec.name);
  require_two_nodes(subject, spec, spec.where, bushing.a, bushing.b);
  place_markers(markers_, spec, bushing.a, bushing.b);
  // Translations act along the axes of A, so B needs an orientation only if rotations take part.
  const bool rotations = spec.turns || spec.takes_turns(0) || spec.takes_turns(1) || spec.takes_turns(2);
  const bool b_has_axes = bushing.b.node < 0 || has_rotation(model_, bushing.b.node);
  check_marker(model_, subject, {true, true, !rotations && b_has_axes}, spec.a, bushing.a);
  check_marker(model_, subject, rotations ? use_position_and_axes : use_position, spec.b, bushing.b);
  bushing.stiffness = spec.stiffness;
  bushing.damping = spec.damping;
  bushing.free = spec.free.value_or(bushing.free);
  bushing.free_at_start = !spec.free;
  bushing.preload = spec.preload;
  bushing.rotations = rotations;
  if (const std::optional<int> axis = spec.turning_axis()) {
    bushing.axis = *axis;
    bushing.coordinate = count_of(model_.coordinates);
    Coordinate turn{
        spec.name + "/turn", bushing.a, bushing.b, {RelationKind::angle, static_cast<std::uint8_t>(*axis), 0}};
    turn.active = true;
    model_.coordinates.push_back(turn);
  }
  model_.bushings.push_back(std::move(bushing));
}

std::string JointBuilder::turned_at_start(const std::vector<formats::BushingSpec>& bushings) const {
  constexpr double visible = 1e-3;  // rad
  std::vector<std::string> names;
  for (const formats::BushingSpec& spec : bushings) {
    const bool turns = spec.takes_turns(0) || spec.takes_turns(1) || spec.takes_turns(2);
    if (!turns || !spec.free || spec.axis || (spec.a.orientation && spec.b.orientation)) continue;
    const Eigen::Matrix3d R =
        markers_.motion(markers_.find(spec.a).node).R.transpose() * markers_.motion(markers_.find(spec.b).node).R;
    const double angle = Eigen::AngleAxisd(R).angle();
    if (angle > visible) names.push_back(fmt::format("bushing '{}' ({:.3g} rad)", spec.name, angle));
  }
  if (names.empty()) return "";
  return fmt::format(
      "{}: the bodies have different orientations at the start. 'free' is measured from there, because the markers "
      "have the same axes at the start. If 'free' is relative to the axes of the bodies, give both markers an "
      "orientation",
      listed(names));
}

void JointBuilder::require_two_nodes(const std::string& subject, const formats::MarkerPairSpec& spec,
                                     const std::string& where, const Marker& a, const Marker& b) {
  if (a.node != b.node) return;
  throw Error(fmt::format("{} connects '{}' and '{}', which do not move relative to each other", subject, spec.a.node,
                          spec.b.node),
              where, "connect two different nodes");
}

void JointBuilder::add(const formats::InputSpec& spec) {
  const std::vector<double>& time = spec.table.time;
  const bool linear = spec.interpolation == formats::Interpolation::linear;
  const formats::CurveSpec curve{spec.interpolation, time, spec.table.value};
  model_.scope.inputs.push_back(
      std::make_shared<const Input>(Input{formats::expression_name(spec.name), Curve(curve), time.front(), time.back(),
                                          linear ? time : std::vector{time.front(), time.back()}}));
}

void JointBuilder::add(const formats::ChannelSpec& spec) {
  Channel channel;
  channel.name = spec.name;
  channel.kind = spec.kind;
  channel.axis = spec.axis;
  channel.origin = spec.origin - markers_.origin;
  const std::string subject = fmt::format("channel '{}'", spec.name);
  switch (spec.kind) {
    case formats::ChannelKind::coordinate:
    case formats::ChannelKind::rate:
      channel.coordinate = find_coordinate(spec.coordinate);
      break;
    case formats::ChannelKind::distance: {
      formats::MarkerPairSpec pair;
      pair.a = spec.a;
      pair.b = spec.b;
      channel.coordinate = add_distance(spec.name, subject, pair, spec.where);
      break;
    }
    case formats::ChannelKind::position:
    case formats::ChannelKind::velocity:
      channel.a = markers_.find(spec.a);
      check_marker(model_, subject, use_position, spec.a, channel.a);
      break;
    case formats::ChannelKind::tyre: {
      const auto tyre = std::ranges::find(model_.tyres, spec.tyre, &Tyre::name);
      TISSERAND_ENSURE(tyre != model_.tyres.end(), "no tyre '{}'", spec.tyre);
      channel.tyre = static_cast<int>(tyre - model_.tyres.begin());
      channel.quantity = spec.quantity;
      channel.a = tyre->wheel;
      break;
    }
  }
  if (channel.coordinate >= 0) {
    Coordinate& coordinate = model_.coordinates[channel.coordinate];
    coordinate.active = true;
    channel.a = coordinate.a;
    channel.b = coordinate.b;
  }
  model_.scope.channels.push_back(formats::expression_name(spec.name));
  model_.channels.push_back(std::move(channel));
}

void note_function(const formats::TimeFunctionSpec& spec, ChannelUse use, Model& model, std::set<double>& breakpoints) {
  const TimeFunction function(spec, model.scope);
  breakpoints.insert(function.breakpoints().begin(), function.breakpoints().end());
  for (int i = 0; i < std::ssize(function.channels()); ++i) {
    use.argument = i;
    use.channel = function.channels()[i];
    model.channel_uses.push_back(use);
  }
}

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Search of places by name.
#include "mechanism/build/markers.hpp"

#include <functional>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/stable_sort.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Place that a marker names (without the marker's own offset).
Marker find_place(const MarkerTable& markers, const formats::MarkerSpec& spec) {
  if (spec.node == "ground") {
    Marker ground;
    ground.p -= markers.origin;
    return ground;
  }
  const auto& places = markers.places;
  const auto found = places.find(spec.node);
  if (found != places.end()) return found->second;
  std::vector<std::string> names{"ground"};
  for (const auto& [name, marker] : places) names.push_back(name);
  const auto suggestion = nearest(spec.node, names);
  throw Error(fmt::format("there is no node '{}'", spec.node), spec.where,
              suggestion ? fmt::format("did you mean '{}'?", *suggestion) : "the scene has " + listed(names));
}

Marker with_offset(Marker marker, const formats::MarkerSpec& spec) {
  if (spec.position) marker.p += marker.R * *spec.position;
  if (spec.orientation) marker.R *= spec.orientation->normalized().toRotationMatrix();
  return marker;
}

Matrix3d frame_with_z(const Vector3d& axis, const std::optional<Vector3d>& x_axis) {
  const Vector3d z = axis.normalized();
  Eigen::Index smallest = 0;
  z.cwiseAbs().minCoeff(&smallest);
  const Vector3d across = x_axis ? *x_axis : Vector3d(Vector3d::Unit(smallest));
  const Vector3d x = (across - z.dot(across) * z).normalized();
  Matrix3d R;
  R << x, z.cross(x), z;
  return R;
}

/// Gives the marker the world pose (position, R) where the scene does not set its own.
void place_marker(const MarkerTable& markers, const formats::MarkerSpec& spec, const Vector3d& position,
                  const Matrix3d& R, Marker& marker) {
  const NodeMotion carrier = markers.motion(marker.node);
  if (!spec.position) marker.p = carrier.R.transpose() * (position - carrier.x);
  if (!spec.orientation) marker.R = carrier.R.transpose() * R;
}

}  // namespace

void place_markers(const MarkerTable& markers, const formats::MarkerPairSpec& spec, Marker& a, Marker& b) {
  const bool at_a = spec.b.node == "ground" || (spec.a.position && !spec.b.position);
  const Vector3d position = spec.position ? Vector3d(*spec.position - markers.origin) : markers.position(at_a ? a : b);
  Matrix3d R = Matrix3d::Identity();
  if (spec.axis)
    R = frame_with_z(*spec.axis, spec.x_axis);
  else if (spec.a.orientation)
    R = marker_rotation(a, markers.motion(a.node));
  else if (spec.b.orientation)
    R = marker_rotation(b, markers.motion(b.node));
  place_marker(markers, spec.a, position, R, a);
  place_marker(markers, spec.b, position, R, b);
}

Marker MarkerTable::find(const formats::MarkerSpec& spec) const { return with_offset(find_place(*this, spec), spec); }

void check_marker(const Model& model, const std::string& subject, MarkerUse use, const formats::MarkerSpec& place,
                  const Marker& marker) {
  if (marker.node < 0) return;
  if (use.position && !has_translation(model, marker.node))
    throw Error(fmt::format("{} holds the position of node '{}', which has no translations", subject, place.node),
                place.where, "keep the translations of that node in the superelement");
  if (has_rotation(model, marker.node)) return;
  if (use.axes && use.other_way_round)
    throw Error(
        fmt::format("{} takes its axes from node '{}', which has no rotations", subject, place.node), place.where,
        "exchange a and b, because the axes are those of a; or keep the rotations of that node in the superelement");
  if (use.axes)
    throw Error(fmt::format("{} holds the rotation of node '{}', which has none", subject, place.node), place.where,
                "use a spherical joint, or keep the rotations of that node in the superelement");
  if (use.position && marker.p.norm() > 1e-12 * model.length)
    throw Error(fmt::format("{} is {:.3g} away from node '{}', which has no rotations to carry the offset", subject,
                            marker.p.norm(), place.node),
                place.where, "put it at the node, or keep the rotations of that node in the superelement");
}

void add_rigid_arms(const MarkerTable& markers, const formats::JointSpec& spec, const Joint& joint, double length,
                    std::vector<RigidArm>& arms) {
  constexpr double shown = 1e-6;
  const bool reported = spec.position || spec.a.position || spec.b.position;
  const bool axes_kept = keeps_orientation(joint) || aligned_axis(joint) >= 0;
  const auto add = [&](const formats::MarkerSpec& side, const Marker& marker) {
    if (marker.node < 0 || side.position || (reported && markers.frames.contains(side.node))) return;
    const Vector3d arm = markers.position(marker) - markers.position(markers.find(side));
    const Vector3d in_A = marker_rotation(joint.a, markers.motion(joint.a.node)).transpose() * arm;
    const bool is_b = &side == &spec.b;
    const double held = is_b && !axes_kept && depends_on(joint).places ? arm.norm() : held_length(joint, in_A);
    if (held > shown * length) arms.push_back({spec.name, side.node, held});
  };
  if (keeps_distance(joint)) return;
  add(spec.a, joint.a);
  add(spec.b, joint.b);
}

std::string rigid_arms_text(std::vector<RigidArm> arms, const Units& units) {
  if (arms.empty()) return {};
  sort_stably(arms, std::greater{}, &RigidArm::length);
  const std::string unit = after_number(unit_label(units, 1, 0, 0));
  std::vector<std::string> texts;
  for (const RigidArm& arm : arms)
    texts.push_back(fmt::format("'{}' {:.4g}{} from '{}'", arm.joint, arm.length, unit, arm.place));
  return "rigid arms connect joints with the nodes that they name: " + listed(texts);
}

}  // namespace tisserand::mechanism

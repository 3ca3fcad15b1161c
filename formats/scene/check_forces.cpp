// SPDX-License-Identifier: GPL-3.0-or-later
// Checks springs, bushings and loads.
#include <cmath>
#include <numbers>
#include <tuple>

#include <Eigen/Eigenvalues>

#include "common/text.hpp"
#include "formats/scene/check_parts.hpp"
#include "formats/scene/time_function_reader.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

void check_law(const LawSpec& law, const std::string& key, const Subject& subject) {
  if (const CurveSpec* curve = std::get_if<CurveSpec>(&law))
    check_curve(*curve, key, subject);
  else
    subject.finite(key, std::get<double>(law));
}

/// Checks that a damper dissipates energy at all rates.
void check_damper(const LawSpec& law, const Subject& subject) {
  const CurveSpec* curve = std::get_if<CurveSpec>(&law);
  check_law(law, "damping", subject);
  if (curve == nullptr && std::get<double>(law) < 0.0) subject.not_negative("damping", std::get<double>(law));
  if (curve == nullptr) return;
  for (std::size_t i = 0; i < std::min(curve->x.size(), curve->y.size()); ++i)
    if (curve->x[i] * curve->y[i] < 0.0) {
      subject.add("damping",
                  fmt::format("the table of damping adds energy: force {:g} and rate {:g} have opposite signs",
                              curve->y[i], curve->x[i]),
                  "give forces with the sign of the rate");
      return;
    }
}

void check_stops(const SpringSpec& spring, const Subject& subject) {
  subject.not_negative("stop_damping", spring.stop_damping);
  if (spring.lower || spring.upper) subject.not_negative("stop_stiffness", spring.stop_stiffness);
  if (spring.lower && spring.upper && !(*spring.lower < *spring.upper))
    subject.add("lower", fmt::format("lower stop {:g} is not below the upper one {:g}", *spring.lower, *spring.upper));
}

/// Checks that a body of that name exists and that it does not give the same velocity itself.
void check_initial_body(const SceneIndex& scene, const InitialSpec& initial, const Subject& subject) {
  const auto body = scene.bodies.find(initial.coordinate.name);
  if (body == scene.bodies.end()) {
    subject.add("", "there is no body of this name",
                "give velocity and angular_velocity for a body, value and rate for a coordinate");
    return;
  }
  const InitialMotion& start =
      std::visit([](const auto& spec) -> const InitialMotion& { return spec.start; }, *body->second);
  if (initial.value || initial.rate) subject.add("", "value and rate have no effect on a body", "remove them");
  for (const auto& [own, given, key] :
       {std::tuple{&start.velocity, &initial.velocity, "velocity"},
        std::tuple{&start.angular_velocity, &initial.angular_velocity, "angular_velocity"}}) {
    if (*given) subject.finite(key, **given);
    if (*own && *given) subject.add(key, fmt::format("the body itself gives {}", key), "remove one");
  }
}

}  // namespace

void check_friction(const JointSpec& joint, const Subject& subject) {
  const FrictionSpec& friction = *joint.friction;
  const FrictionKeys keys = joint_kind(joint.kind).friction;
  if (!keys.has_friction)
    subject.add("friction",
                fmt::format("a {} joint has no contact surface and therefore no friction", joint_word(joint.kind)),
                "remove it, or combine kinds of joints that have a contact surface (formats/SCENE.md)");
  const Subject inner = subject.inside("friction");
  inner.not_negative("coefficient", friction.coefficient);
  const double stiction = friction.static_coefficient.value_or(friction.coefficient);
  if (!(stiction >= friction.coefficient && std::isfinite(stiction)))
    inner.add("static_coefficient",
              fmt::format("static_coefficient {:g} is below the coefficient {:g}", stiction, friction.coefficient));
  inner.positive("velocity", friction.velocity);
  if (keys.radius) inner.positive("radius", friction.radius);
  inner.positive("arm", friction.arm);
  if (friction.arm && keys.has_friction && !keys.arm)
    inner.add("arm", fmt::format("a {} joint takes no moment", joint_word(joint.kind)), "remove arm");
}

void check_initial(const SceneIndex& scene, const InitialSpec& initial, Faults& faults) {
  const Subject subject{fmt::format("initial '{}'", initial.coordinate.name), initial.where, faults};
  if (initial.of_body()) {
    check_initial_body(scene, initial, subject);
    return;
  }
  check_coordinate(initial.coordinate, scene, "", subject);
  if (!initial.value && !initial.rate) subject.add("", "neither value nor rate is given", "give one or both");
  for (const auto& [number, key] : {std::pair{initial.value, "value"}, std::pair{initial.rate, "rate"}})
    if (number) subject.finite(key, *number);
}

void check_spring(const SceneIndex& scene, const SpringSpec& spring, const Subject& subject) {
  if (spring.coordinate) {
    check_coordinate(*spring.coordinate, scene, "coordinate", subject);
  } else if (spring.kind == SpringKind::torsion) {
    check_marker_pair(scene, spring, subject);
    if (!spring.axis && !spring.a.orientation && !spring.b.orientation)
      subject.add("", "a spring of type torsion needs an axis", "give axis: [x, y, z], or an orientation to a or b");
  } else {
    check_marker(scene, spring.a, "a", subject);
    check_marker(scene, spring.b, "b", subject);
  }
  check_law(spring.stiffness, "stiffness", subject);
  check_damper(spring.damping, subject);
  check_stops(spring, subject);
  if (spring.force) check_time_function(*spring.force, "force", subject);
}

void check_bushing(const SceneIndex& scene, const BushingSpec& bushing, const Subject& subject) {
  check_marker_pair(scene, bushing, subject);
  subject.finite("stiffness", bushing.stiffness);
  subject.finite("preload", bushing.preload);
  if (bushing.free) {
    subject.finite("free", *bushing.free);
    Eigen::Vector3d turn = bushing.free->tail<3>();
    if (const std::optional<int> axis = bushing.turning_axis()) turn[*axis] = 0.0;
    if (!(turn.norm() < std::numbers::pi))
      subject.add("free", "the rotation vector of 'free' is half a turn or more",
                  "change the orientation of one marker instead");
  }
  if (subject.finite("damping", bushing.damping)) {
    const Eigen::MatrixXd symmetric = 0.5 * (bushing.damping + bushing.damping.transpose());
    const double smallest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues()[0];
    if (!(smallest >= -1e-12 * symmetric.cwiseAbs().maxCoeff()))
      subject.add("damping",
                  fmt::format("the symmetric part of the damping matrix has the negative eigenvalue {:g}", smallest),
                  "give a matrix whose symmetric part has no negative eigenvalue");
  }
}

void check_load(const SceneIndex& scene, const LoadSpec& load, const Subject& subject) {
  check_marker(scene, load.at, "at", subject);
  for (std::size_t i = 0; i < load.components.size(); ++i)
    check_time_function(load.components[i], fmt::format("value[{}]", i), subject);
}

void check_part_load(const SceneIndex& scene, const PartLoadSpec& load, const Subject& subject) {
  check_time_function(load.value, "value", subject);
  const auto body = scene.bodies.find(load.body);
  if (body != scene.bodies.end() && std::holds_alternative<SuperelementBodySpec>(*body->second)) return;
  std::vector<std::string> superelements;
  for (const BodySpec& one : scene.scene.bodies)
    if (const auto* spec = std::get_if<SuperelementBodySpec>(&one)) superelements.push_back(spec->name);
  if (body == scene.bodies.end())
    check_reference(subject, "body", "superelement", load.body, superelements);
  else
    subject.add("body", fmt::format("body '{}' is not a superelement", load.body),
                superelements.empty() ? "load cases belong to superelements: give a load at a marker"
                                      : "use one of " + listed(superelements));
}

}  // namespace tisserand::formats

// Findings of springs, bushings and loads.
#include <cmath>
#include <tuple>

#include <Eigen/Eigenvalues>

#include "common/text.hpp"
#include "formats/scene/check_parts.hpp"
#include "formats/scene/time_function_reader.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {

namespace {

void check_law(const LawSpec& law, const std::string& subject, const std::string& where, const std::string& key,
               Faults& faults) {
  if (const CurveSpec* curve = std::get_if<CurveSpec>(&law))
    check_curve(*curve, subject, where, key, faults);
  else if (!std::isfinite(std::get<double>(law)))
    faults.add(where, key, fmt::format("{}: {} must be finite", subject, key), "");
}

/// A damper takes energy out at all rates.
void check_damper(const LawSpec& law, const std::string& subject, const std::string& where, Faults& faults) {
  check_law(law, subject, where, "damping", faults);
  const CurveSpec* curve = std::get_if<CurveSpec>(&law);
  if (curve == nullptr) {
    if (std::get<double>(law) < 0.0)
      faults.add(where, "damping", fmt::format("{}: damping {:g} must not be negative", subject, std::get<double>(law)),
                 "");
    return;
  }
  for (std::size_t i = 0; i < std::min(curve->x.size(), curve->y.size()); ++i)
    if (curve->x[i] * curve->y[i] < 0.0) {
      faults.add(where, "damping",
                 fmt::format("{}: the table of damping drives the motion: force {:g} at rate {:g}", subject,
                             curve->y[i], curve->x[i]),
                 "give forces with the sign of the rate");
      return;
    }
}

void check_stops(const SpringSpec& spring, const std::string& subject, Faults& faults) {
  if (!(spring.stop_damping >= 0.0 && std::isfinite(spring.stop_damping)))
    faults.add(spring.where, "stop_damping",
               fmt::format("{}: stop_damping {:g} must not be negative", subject, spring.stop_damping), "");
  if ((spring.lower || spring.upper) && !(spring.stop_stiffness >= 0.0 && std::isfinite(spring.stop_stiffness)))
    faults.add(spring.where, "stop_stiffness",
               fmt::format("{}: stop_stiffness {:g} must not be negative", subject, spring.stop_stiffness), "");
  if (spring.lower && spring.upper && !(*spring.lower < *spring.upper))
    faults.add(
        spring.where, "lower",
        fmt::format("{}: lower stop {:g} is not below the upper one {:g}", subject, *spring.lower, *spring.upper), "");
}

/// A body of that name, which has no such velocity of its own.
void check_initial_body(const SceneIndex& scene, const InitialSpec& initial, const std::string& subject,
                        Faults& faults) {
  const auto body = scene.bodies.find(initial.coordinate.name);
  if (body == scene.bodies.end()) {
    faults.add(initial.where, "", fmt::format("{}: there is no body of this name", subject),
               "velocities belong to bodies; coordinates have value and rate");
    return;
  }
  const InitialMotion& start =
      std::visit([](const auto& spec) -> const InitialMotion& { return spec.start; }, *body->second);
  if (initial.value || initial.rate)
    faults.add(initial.where, "", fmt::format("{}: a body has neither value nor rate", subject), "remove them");
  for (const auto& [own, given, key] :
       {std::tuple{&start.velocity, &initial.velocity, "velocity"},
        std::tuple{&start.angular_velocity, &initial.angular_velocity, "angular_velocity"}}) {
    if (*given && !(*given)->allFinite())
      faults.add(initial.where, key, fmt::format("{}: {} must be finite", subject, key), "");
    if (*own && *given)
      faults.add(initial.where, key, fmt::format("{}: the body has a {} of its own", subject, key), "remove one");
  }
}

}  // namespace

void check_friction(const JointSpec& joint, const std::string& subject, Faults& faults) {
  const FrictionSpec& friction = *joint.friction;
  const FrictionKeys keys = joint_kind(joint.kind).friction;
  if (!keys.has_friction)
    faults.add(joint.where, "friction",
               fmt::format("{}: a {} joint has no contact surface, so no friction", subject, joint_word(joint.kind)),
               "remove it, or make the joint of kinds that have one (formats/SCENE.md)");
  const auto positive = [&](double value, const char* key) {
    if (!(value > 0.0 && std::isfinite(value)))
      faults.add(joint.where, fmt::format("friction.{}", key),
                 fmt::format("{}: friction: {} {:g} must be positive", subject, key, value), "");
  };
  if (!(friction.coefficient >= 0.0 && std::isfinite(friction.coefficient)))
    faults.add(joint.where, "friction.coefficient",
               fmt::format("{}: friction: coefficient {:g} must not be negative", subject, friction.coefficient), "");
  const double stiction = friction.static_coefficient.value_or(friction.coefficient);
  if (!(stiction >= friction.coefficient && std::isfinite(stiction)))
    faults.add(joint.where, "friction.static_coefficient",
               fmt::format("{}: friction: static_coefficient {:g} is below the coefficient {:g}", subject, stiction,
                           friction.coefficient),
               "");
  positive(friction.velocity, "velocity");
  if (keys.radius) positive(friction.radius, "radius");
  if (friction.arm) positive(*friction.arm, "arm");
  if (friction.arm && keys.has_friction && !keys.arm)
    faults.add(joint.where, "friction.arm",
               fmt::format("{}: friction: a {} joint takes no moment", subject, joint_word(joint.kind)), "remove arm");
}

void check_initial(const SceneIndex& scene, const InitialSpec& initial, Faults& faults) {
  const std::string subject = fmt::format("initial '{}'", initial.coordinate.name);
  if (initial.of_body()) {
    check_initial_body(scene, initial, subject, faults);
    return;
  }
  check_coordinate(initial.coordinate, scene, subject, initial.where, "", faults);
  if (!initial.value && !initial.rate)
    faults.add(initial.where, "", fmt::format("{}: neither value nor rate is given", subject), "give one or both");
  for (const auto& [number, key] : {std::pair{initial.value, "value"}, std::pair{initial.rate, "rate"}})
    if (number && !std::isfinite(*number))
      faults.add(initial.where, key, fmt::format("{}: {} must be finite", subject, key), "");
}

void check_spring(const SceneIndex& scene, const SpringSpec& spring, Faults& faults) {
  const std::string subject = fmt::format("spring '{}'", spring.name);
  if (spring.coordinate) {
    check_coordinate(*spring.coordinate, scene, subject, spring.where, "coordinate", faults);
  } else if (spring.kind == SpringKind::torsion) {
    check_marker_pair(scene, spring, subject, spring.where, faults);
    if (!spring.axis && !spring.a.orientation && !spring.b.orientation)
      faults.add(spring.where, "", fmt::format("{}: a spring of type torsion needs an axis", subject),
                 "give axis: [x, y, z], or an orientation to a or b");
  } else {
    check_marker(scene, spring.a, subject, spring.where, "a", faults);
    check_marker(scene, spring.b, subject, spring.where, "b", faults);
  }
  check_law(spring.stiffness, subject, spring.where, "stiffness", faults);
  check_damper(spring.damping, subject, spring.where, faults);
  check_stops(spring, subject, faults);
  if (spring.force) check_time_function(*spring.force, subject, spring.where, "force", faults);
}

void check_bushing(const SceneIndex& scene, const BushingSpec& bushing, Faults& faults) {
  const std::string subject = fmt::format("bushing '{}'", bushing.name);
  check_marker_pair(scene, bushing, subject, bushing.where, faults);
  const auto finite = [&](const auto& matrix, const char* key) {
    if (!matrix.allFinite()) faults.add(bushing.where, key, fmt::format("{}: {} must be finite", subject, key), "");
    return matrix.allFinite();
  };
  finite(bushing.stiffness, "stiffness");
  finite(bushing.preload, "preload");
  if (bushing.free) finite(*bushing.free, "free");
  if (bushing.free) {
    Eigen::Vector3d turn = bushing.free->tail<3>();
    if (const std::optional<int> axis = bushing.turning_axis()) turn[*axis] = 0.0;
    if (!(turn.norm() < EIGEN_PI))
      faults.add(bushing.where, "free", fmt::format("{}: the rotation vector of free is half a turn or more", subject),
                 "turn the orientation of one marker instead");
  }
  if (finite(bushing.damping, "damping")) {
    const Eigen::MatrixXd symmetric = 0.5 * (bushing.damping + bushing.damping.transpose());
    const double smallest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues()[0];
    if (!(smallest >= -1e-12 * symmetric.cwiseAbs().maxCoeff()))
      faults.add(bushing.where, "damping",
                 fmt::format("{}: the damping matrix has the eigenvalue {:g}", subject, smallest),
                 "its symmetric part must not be negative in any direction");
  }
}

void check_load(const SceneIndex& scene, const LoadSpec& load, Faults& faults) {
  const std::string subject = fmt::format("load '{}'", load.name);
  check_marker(scene, load.at, subject, load.where, "at", faults);
  for (std::size_t i = 0; i < load.components.size(); ++i)
    check_time_function(load.components[i], subject, load.where, fmt::format("value[{}]", i), faults);
}

void check_part_load(const SceneIndex& scene, const PartLoadSpec& load, Faults& faults) {
  const std::string subject = fmt::format("load '{}'", load.name);
  check_time_function(load.value, subject, load.where, "value", faults);
  const auto body = scene.bodies.find(load.body);
  if (body != scene.bodies.end() && std::holds_alternative<SuperelementBodySpec>(*body->second)) return;
  std::vector<std::string> superelements;
  for (const BodySpec& one : scene.scene.bodies)
    if (const auto* spec = std::get_if<SuperelementBodySpec>(&one)) superelements.push_back(spec->name);
  if (body == scene.bodies.end())
    check_reference(subject, "superelement", load.body, superelements, load.where, "body", faults);
  else
    faults.add(load.where, "body", fmt::format("{}: body '{}' is no superelement", subject, load.body),
               superelements.empty() ? "load cases belong to superelements: give a load at a marker"
                                     : "the superelements are " + listed(superelements));
}

}  // namespace tisserand::formats

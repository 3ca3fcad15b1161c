// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of numbers of a scene. The limits lie far beyond usual designs; a unit error is mostly a factor of 1000.
#include "mechanism/analyses/number_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <variant>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "common/text.hpp"
#include "formats/sections/substance.hpp"
#include "mechanism/model/forces.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Vector3d;

/// Standard gravity is 9.81 m/s². The surface of the Sun has 274, a small moon (Mimas) 0.06.
constexpr double least_gravity = 0.03, most_gravity = 300.0;  // [m/s²]
constexpr double most_friction = 3.0;                         // rubber on dry ground has 1 to 1.5
constexpr double most_damping = 2.0;                          // dampers in cars 0.2 to 0.4, critical 1
constexpr double most_gyration = 100.0;  // of the extents of body and scene: a flywheel on a short bearing has some 20
constexpr double most_section = 5.0;     // radius of gyration of a section, over the length of the beam
constexpr double most_free_length = 100.0;  // of a spring, over its length at the start
/// A uniform rod has its ends at 1.73 radii of gyration. A ball on a thin rod has them further away, the lighter the
/// rod: at 5 radii the rod weighs an eighth. Compact bodies are not checked: they may be on massless arms.
constexpr double most_reach = 5.0;
constexpr double most_slender = 0.1;  // least over largest principal moment of inertia

constexpr int most_listed = 3;  // largest number of messages of one kind; further ones are only counted

/// Messages by kind. If many parts share one mistake, only a few are named.
class Doubts {
 public:
  explicit Doubts(const formats::Scene& scene) : units(scene.units) {}

  template <class... T>
  void add(fmt::format_string<T...> format, T&&... values) {
    const fmt::string_view pattern = format;
    Kind& kind = kinds_[std::string(pattern.data(), pattern.size())];
    std::string text = fmt::format(format, std::forward<T>(values)...);
    if (std::ranges::find(kind.reported, text) != kind.reported.end()) return;
    if (++kind.count <= most_listed) kind.reported.push_back(std::move(text));
  }
  std::string length(double value) const {
    return fmt::format("{:.4g}{}", value, after_number(unit_label(units, 1, 0, 0)));
  }
  std::vector<std::string> list() && {
    std::vector<std::string> all;
    for (auto& [format, kind] : kinds_) {
      if (kind.count > most_listed)
        kind.reported.back() += fmt::format(" (and {} more like this)", kind.count - most_listed);
      std::ranges::move(kind.reported, std::back_inserter(all));
    }
    return all;
  }

  const Units& units;

 private:
  struct Kind {
    std::vector<std::string> reported;
    int count = 0;
  };
  std::map<std::string, Kind> kinds_;
};

void doubt_gravity(const std::string& whose, const Vector3d& g, Doubts& doubts) {
  const Units& units = doubts.units;
  if (!units.named() || g.isZero(0.0)) return;
  const double si = g.norm() * units.length.factor / (units.time.factor * units.time.factor);
  if (si >= least_gravity && si <= most_gravity) return;
  doubts.add("{} is {:.4g}{}, that is {:.3g} m/s^2: the Earth's gravity is {:.4g} in these units", whose, g.norm(),
             after_number(unit_label(units, 1, 0, -2)), si,
             9.81 * units.time.factor * units.time.factor / units.length.factor);
}

void doubt_damping(const std::string& name, const formats::Damping& damping, Doubts& doubts) {
  std::vector<double> all{damping.ratio, damping.ratio_internal};
  all.insert(all.end(), damping.ratios.begin(), damping.ratios.end());
  all.insert(all.end(), damping.ratios_internal.begin(), damping.ratios_internal.end());
  const double largest = *std::ranges::max_element(all);
  if (largest > most_damping)
    doubts.add("'{}' has a damping ratio of {:.4g}: 1 is critical, {:.4g} per cent is {:.4g}", name, largest, largest,
               0.01 * largest);
}

/// Checks inertias if the scene has a size, that of several bodies: a single disc with 10 µm imbalance is no mistake.
void doubt_inertia(const formats::Scene& scene, const Model& model, Doubts& doubts) {
  if (scene.bodies.size() < 2) return;
  for (const formats::BodySpec& any : scene.bodies) {
    const auto* body = std::get_if<formats::RigidBodySpec>(&any);
    if (body == nullptr) continue;
    Eigen::AlignedBox3d box(Vector3d::Zero());  // the part frame is a node too
    for (const formats::RigidNodeSpec& node : body->nodes) box.extend(node.pose.position);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(body->inertia, Eigen::EigenvaluesOnly);
    const double gyration = std::sqrt(principal.eigenvalues()[2] / body->mass);
    if (gyration > most_gyration * std::max(model.length, box.diagonal().norm()))
      doubts.add("'{}' has a radius of gyration of {}, but the scene has an extent of {}: check `inertia`", body->name,
                 doubts.length(gyration), doubts.length(model.length));
  }
}

void doubt_body(const formats::RigidBodySpec& /*body*/, Doubts& /*doubts*/) {}

void doubt_body(const formats::BeamBodySpec& beam, Doubts& doubts) {
  const formats::Section& section = beam.section;
  if (!section.by_stiffness) {
    const std::string what =
        beam.material.name.empty() ? fmt::format("'{}'", beam.name) : fmt::format("material '{}'", beam.material.name);
    if (const std::string text = formats::substance_doubt({what, beam.material.youngs_modulus, beam.material.density},
                                                          doubts.units, "the scene");
        !text.empty())
      doubts.add("{}", text);
  }
  const double length = (beam.to - beam.from).norm() + (beam.through ? (*beam.through - beam.from).norm() : 0.0);
  const double gyration =
      section.area > 0.0 ? std::sqrt(std::max(section.second_moment_y, section.second_moment_z) / section.area) : 0.0;
  if (!section.by_stiffness && gyration > most_section * length)
    doubts.add("the section of '{}' has a radius of gyration of {}, but the beam has a length of {}", beam.name,
               doubts.length(gyration), doubts.length(length));
}

void doubt_body(const formats::SuperelementBodySpec& body, Doubts& doubts) {
  doubt_damping(body.name, body.damping, doubts);
}
void doubt_body(const formats::ModalBodySpec& body, Doubts& doubts) { doubt_damping(body.name, body.damping, doubts); }
void doubt_body(const formats::VirtualBodySpec& /*body*/, Doubts& /*doubts*/) {}

void doubt_friction(const std::string& whose, double coefficient, Doubts& doubts) {
  if (coefficient > most_friction)
    doubts.add("{} has a coefficient of friction of {:.4g}: rubber on dry ground has 1 to 1.5", whose, coefficient);
}

/// Reports tables of time that end before the run or begin after it.
void doubt_times(const formats::Scene& scene, Doubts& doubts) {
  const double start = scene.integrator.start, end = scene.integrator.end;
  const std::string second = after_number(unit_label(scene.units, 0, 0, 1));
  const auto table = [&](const std::string& whose, const formats::TimeTable& held) {
    if (held.time.empty() || (held.time.front() < end && held.time.back() > start)) return;
    const auto [least, most] = std::ranges::minmax(held.value);
    if (least == most) return;  // the table is constant on purpose
    doubts.add("the table of {} covers {:g} to {:g}{}, but the run goes from {:g} to {:g}{}: the value is constant",
               whose, held.time.front(), held.time.back(), second, start, end, second);
  };
  const auto function = [&](const std::string& whose, const formats::TimeFunctionSpec& spec) {
    if (const auto* values = std::get_if<formats::TimeTable>(&spec)) table(whose, *values);
  };
  for (const formats::LoadSpec& load : scene.loads)
    for (const formats::TimeFunctionSpec& component : load.components)
      function(fmt::format("load '{}'", load.name), component);
  for (const formats::PartLoadSpec& load : scene.part_loads) function(fmt::format("load '{}'", load.name), load.value);
  for (const formats::MotionSpec& motion : scene.motions)
    function(fmt::format("motion '{}'", motion.name), motion.value);
  for (const formats::SpringSpec& spring : scene.springs)
    if (spring.force) function(fmt::format("spring '{}'", spring.name), *spring.force);
  for (const formats::InputSpec& input : scene.inputs) table(fmt::format("input '{}'", input.name), input.table);
  if (const auto interval = scene.output.interval; interval && *interval > end - start)
    doubts.add(
        "`output: {{interval: {:g}}}` is longer than the run of {:g}{}: only its first and last instants are stored",
        *interval, end - start, second);
}

void doubt_free_lengths(const Model& model, const Evaluation& now, Doubts& doubts) {
  for (const Spring& spring : model.springs) {
    if (spring.free_at_start || model.coordinates[spring.coordinate].relation.kind != RelationKind::distance) continue;
    const double length = now.coordinates[spring.coordinate].value;
    if (length > 1e-3 * model.length && spring.free > most_free_length * length)
      doubts.add("spring '{}' has a free length of {}, but a length of {} at the start", spring.name,
                 doubts.length(spring.free), doubts.length(length));
  }
}

}  // namespace

std::string far_centres(const Model& model) {
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> nearest(model.nodes.size(), none);  // the node of a rigid body is at its centre of mass
  const auto hold = [&](const Marker& marker) {
    if (marker.node >= 0) nearest[marker.node] = std::min(nearest[marker.node], marker.p.norm());
  };
  const auto hold_both = [&](const auto& pool) {
    for (const auto& one : pool) {
      hold(one.a);
      hold(one.b);
    }
  };
  hold_both(model.joints);
  hold_both(model.ties);
  hold_both(model.coordinates);
  for_each_force(model, [&](auto traits, const auto& force) {
    for (const auto marker : traits.markers)
      if (traits.connects) hold(force.*marker);
  });
  std::vector<std::string> texts;
  for (const RigidBody& body : model.rigid_bodies) {
    const double distance = nearest[body.node];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(body.inertia, Eigen::EigenvaluesOnly);
    const Vector3d moments = principal.eigenvalues();
    const double gyration = std::sqrt(moments[2] / body.mass);
    if (distance == none || moments[0] > most_slender * moments[2] || distance <= most_reach * gyration) continue;
    texts.push_back(fmt::format("'{}' {:.4g}{} (radius of gyration {:.3g})", body.name, distance,
                                after_number(unit_label(model.units, 1, 0, 0)), gyration));
  }
  if (texts.empty()) return {};
  return "slender bodies with a centre of mass far from their joints and springs: " + listed(texts) +
         ". This is normal for a weight on a light arm; otherwise check `center_of_mass` and `inertia`";
}

std::vector<std::string> number_doubts(const formats::Scene& scene, const Model& model, const Evaluation& now) {
  Doubts doubts(scene);
  doubt_gravity("gravity", scene.gravity, doubts);
  for (const formats::BodySpec& body : scene.bodies)
    std::visit(
        [&](const auto& spec) {
          if constexpr (requires { spec.gravity; })
            if (spec.gravity) doubt_gravity(fmt::format("gravity of '{}'", spec.name), *spec.gravity, doubts);
          doubt_body(spec, doubts);
        },
        body);
  for (const formats::JointSpec& joint : scene.joints)
    if (joint.friction) doubt_friction(fmt::format("joint '{}'", joint.name), joint.friction->coefficient, doubts);
  for (const formats::TyreSpec& tyre : scene.tyres)
    doubt_friction(fmt::format("tyre '{}'", tyre.name), tyre.friction, doubts);
  doubt_inertia(scene, model, doubts);
  if (takes_steps(scene.analysis)) doubt_times(scene, doubts);
  doubt_free_lengths(model, now, doubts);
  return std::move(doubts).list();
}

}  // namespace tisserand::mechanism

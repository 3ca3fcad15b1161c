// SPDX-License-Identifier: GPL-3.0-or-later
// Names, axles, and positions of wheels at the start.
#include "mechanism/build/tyres.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "common/error.hpp"
#include "common/text.hpp"
#include "common/units.hpp"
#include "formats/tyres/tyre_property_file.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Largest angle between axle and joint [rad].
constexpr double parallel_axle = 1e-6;
/// Limits over the radius: penetration at the start, which is an error, and height above the road, which is reported.
constexpr double deepest = 0.5, highest = 1.0;

/// Axes with y along the axle, in the axes of the node.
Matrix3d frame_with_y(const Vector3d& axle) {
  const Vector3d y = axle.normalized();
  Eigen::Index smallest = 0;
  y.cwiseAbs().minCoeff(&smallest);
  const Vector3d x = y.cross(Vector3d(Vector3d::Unit(smallest))).normalized();
  Matrix3d R;
  R << x, y, x.cross(y);
  return R;
}

/// Checks that one of the revolute joints that carry the node, if there are any, has the axle as its axis.
void check_axle(const formats::TyreSpec& spec, const Tyre& tyre, const Construction& c) {
  const Vector3d axle = tyre.wheel.R.col(1);
  const Joint* nearest = nullptr;
  double least = std::numbers::pi;
  for (const Joint& joint : c.model.joints) {
    if (joint.kind != formats::JointKind::revolute && joint.kind != formats::JointKind::cylindrical) continue;
    for (const Marker* marker : {&joint.a, &joint.b}) {
      if (marker->node != tyre.wheel.node || marker->follower != tyre.wheel.follower) continue;
      const Vector3d axis = marker->R.col(2);
      const double angle = std::atan2(axle.cross(axis).norm(), std::abs(axle.dot(axis)));
      if (angle < least) nearest = &joint;
      least = std::min(least, angle);
    }
  }
  if (nearest == nullptr || least <= parallel_axle) return;
  throw Error(fmt::format("tyre '{}': its axle is {:.3g} degrees away from the axis of joint '{}'", spec.name,
                          least * 180.0 / std::numbers::pi, nearest->name),
              spec.where, "set `axis` along the axis of the joint on which the wheel turns");
}

void check_tyre_start(const formats::TyreSpec& spec, const Tyre& tyre, Construction& c) {
  TyreTerms terms;
  const Road& road = c.model.roads[tyre.road];
  evaluate(tyre, road, c.markers.motion(tyre.wheel.node), Tread{}, terms);
  const std::string unit = after_number(unit_label(c.model.units, 1, 0, 0));
  if (terms.normal.isZero(0.0))
    throw Error(fmt::format("tyre '{}': its axle is normal to the road '{}', so the wheel lies on its side", spec.name,
                            road.name),
                spec.where, "set `axis` along the axle, or rotate the road");
  const Vector3d contact = road.R.transpose() * (terms.contact - road.p);
  if (const std::optional<RoadLack> lack = road.lack(contact.x(), contact.y()))
    throw Error(
        lack->hole
            ? fmt::format("tyre '{}' starts in a hole of the road '{}'", spec.name, road.name)
            : fmt::format("tyre '{}' starts at {} = {:.6g}{} of the road '{}', which extends from {:.6g} to {:.6g}",
                          spec.name, lack->axis, lack->at, unit, road.name, lack->begin, lack->end),
        spec.where,
        road.surface ? "move the wheel, or move the road with its `pose`"
                     : "lengthen the curve of the road, or move the wheel");
  if (terms.penetration > deepest * tyre.radius)
    throw Error(
        fmt::format("tyre '{}' starts {:.4g}{} deep in the road '{}'", spec.name, terms.penetration, unit, road.name),
        spec.where, "raise the body, or lower the road with its `pose`");
  if (terms.penetration < -highest * tyre.radius)
    c.notes.push_back(
        fmt::format("tyre '{}' starts {:.4g}{} above the road '{}'", spec.name, -terms.penetration, unit, road.name));
}

/// Takes the law and the vertical spring of a file: F_z = (Q_FZ1 δ/R₀ + Q_FZ2 (δ/R₀)²)(1 + PFZ1 dp_i) F_z0 if it has
/// Q_FZ2. Then Q_FZ1, unless it is given, follows from the stiffness at the nominal load ([Pac12] (4.E68)).
void take_properties(const formats::TyreSpec& spec, Tyre& tyre, Construction& c) {
  MagicFormulaLaw law{spec.properties->coefficients, 0.0, spec.mirrored};
  const formats::MagicFormula& p = law.p;
  if (p.NOMPRES > 0.0) {
    const double pressure = spec.pressure.value_or(p.INFLPRES > 0.0 ? p.INFLPRES : p.NOMPRES);
    law.pressure = pressure / p.NOMPRES - 1.0;
    if ((p.PRESMIN > 0.0 && pressure < p.PRESMIN) || (p.PRESMAX > 0.0 && pressure > p.PRESMAX))
      c.notes.push_back(
          fmt::format("tyre '{}': its pressure {:g} is outside the range for which its file was fitted, {:g} to {:g}",
                      spec.name, pressure, p.PRESMIN, p.PRESMAX));
  }
  tyre.damping = p.VERTICAL_DAMPING;
  const double by_pressure = 1.0 + p.PFZ1 * law.pressure;
  double linear = p.QFZ1;
  const double whole = p.VERTICAL_STIFFNESS * p.UNLOADED_RADIUS / p.FNOMIN;
  if (linear == 0.0) linear = std::sqrt(std::max(whole * whole - 4.0 * p.QFZ2, 0.0));
  if (!(linear > 0.0 && by_pressure > 0.0 && p.QFZ2 >= 0.0))
    throw Error(fmt::format("tyre '{}': the stiffness of its vertical spring is zero or negative, or it decreases with "
                            "deflection (Q_FZ1 {:.4g}, Q_FZ2 {:.4g}, factor of "
                            "the pressure {:.4g})",
                            spec.name, linear, p.QFZ2, by_pressure),
                spec.where, "correct Q_FZ1, Q_FZ2, PFZ1 of the file, or the pressure");
  const bool has_curve = p.QFZ1 != 0.0 || p.QFZ2 != 0.0;
  const double slope = has_curve ? linear * p.FNOMIN / p.UNLOADED_RADIUS : p.VERTICAL_STIFFNESS;
  tyre.stiffness = by_pressure * slope;
  tyre.progressive = by_pressure * p.QFZ2 * p.FNOMIN / (p.UNLOADED_RADIUS * p.UNLOADED_RADIUS);
  if (!spec.properties->unused.empty()) {
    constexpr std::size_t most = 6;
    std::vector<std::string> names = spec.properties->unused;
    const std::size_t more = names.size() > most ? names.size() - most : 0;
    names.resize(names.size() - more);
    const std::string note = fmt::format("{}: keys without effect here: {}{}", spec.properties->version,
                                         join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
    if (std::ranges::find(c.notes, note) == c.notes.end()) c.notes.push_back(note);  // tyres of one file share a note
  }
  tyre.law = std::move(law);
}

/// Adds coordinates for the deflections of the tread.
void give_treads(const formats::TyreSpec& spec, Tyre& tyre, Construction& c) {
  if (c.model.nodes[tyre.wheel.node].modal >= 0)
    throw Error(fmt::format("tyre '{}' has relaxation, but is on a node of a modal body", spec.name), spec.where,
                "put it on a rigid wheel, or remove its relaxation");
  if (const double least = least_relaxation * tyre.radius; spec.relaxation_length && tyre.relaxation < least)
    throw Error(fmt::format("tyre '{}': relaxation_length {:g} is less than a twentieth of its radius, {:.4g}",
                            spec.name, tyre.relaxation, least),
                spec.where, "remove it: so short a tread follows without delay");
  tyre.lag = std::exchange(c.model.sizes.modal, c.model.sizes.modal + 2);
}

/// Checks that the cuts across the line of the latest road do not cross on it.
void check_bends(const formats::RoadSpec& spec, const Construction& c) {
  const Road& road = c.model.roads.back();
  if (!road.surface || !road.surface->line) return;
  const HeightGrid& grid = road.surface->grid;
  const double bend = road.surface->line->sharp_bend(grid.t_begin(), grid.t_end());
  if (std::isnan(bend)) return;
  throw Error(fmt::format("road '{}': its reference line bends so sharply at u = {:.6g}{} that its cross-sections "
                          "intersect within its width",
                          spec.name, bend, after_number(unit_label(c.model.units, 1, 0, 0))),
              spec.where,
              "smooth the headings in the file, or remove the long sections that are that far inside the bend");
}

void add_tyre(const formats::TyreSpec& spec, Construction& c) {
  Tyre tyre;
  tyre.name = spec.name;
  tyre.wheel = c.markers.find(spec.wheel);
  check_marker(c.model, fmt::format("tyre '{}'", spec.name), use_position_and_axes, spec.wheel, tyre.wheel);
  if (tyre.wheel.node < 0)
    throw Error(fmt::format("tyre '{}' is attached to the ground", spec.name), spec.where,
                "name the body of the wheel");
  if (spec.axis) tyre.wheel.R = frame_with_y(c.markers.motion(tyre.wheel.node).R.transpose() * *spec.axis);
  const auto road = std::ranges::find(c.model.roads, spec.road, &Road::name);
  TISSERAND_ENSURE(road != c.model.roads.end(), "no road '{}'", spec.road);
  tyre.road = static_cast<int>(road - c.model.roads.begin());
  tyre.radius = spec.radius;
  tyre.stiffness = spec.stiffness;
  tyre.damping = spec.damping;
  if (spec.properties != nullptr)
    take_properties(spec, tyre, c);
  else
    tyre.law = ComprehensiveSlip{spec.slip_stiffness, spec.cornering_stiffness, spec.camber_stiffness, spec.friction,
                                 spec.sliding_friction.value_or(spec.friction)};
  tyre.relaxation = spec.relaxation_length.value_or(0.0);
  if (spec.relaxation || spec.relaxation_length) give_treads(spec, tyre, c);
  tyre.rolling_resistance = spec.rolling_resistance;
  tyre.low_speed = spec.low_speed;
  check_axle(spec, tyre, c);
  check_tyre_start(spec, tyre, c);
  c.model.tyres.push_back(std::move(tyre));
}

}  // namespace

void add_tyres(Construction& c) {
  for (const formats::RoadSpec& road : c.scene.roads) {
    c.model.roads.emplace_back(road, c.model.origin);
    c.collect([&] { check_bends(road, c); });
  }
  for (const formats::TyreSpec& tyre : c.scene.tyres) c.collect([&] { add_tyre(tyre, c); });
}

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Lines and arcs through points, and their number of elements.
#include "reducer/sources/lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

/// Circular arc from `from` through `through` to `to`.
Curve circle_arc(const Eigen::Vector3d& from, const Eigen::Vector3d& through, const Eigen::Vector3d& to,
                 const formats::BeamLine& line) {
  const Eigen::Vector3d a = through - from, b = to - from;
  const Eigen::Vector3d n = a.cross(b);
  if (!(n.norm() > 1e-9 * a.norm() * b.norm()))
    throw Error(fmt::format("beam '{}': the points of the arc are on a straight line or coincide", line.name),
                line.where,
                "move `through` away from the line between `from` and `to`, or remove it for a straight beam");
  Curve curve{from, to};
  curve.center = from + (b.squaredNorm() * n.cross(a) - a.squaredNorm() * n.cross(b)) / (2.0 * n.squaredNorm());
  curve.radius = (from - curve.center).norm();
  curve.e1 = (from - curve.center) / curve.radius;
  curve.e2 = n.normalized().cross(curve.e1);
  const Eigen::Vector3d end = to - curve.center;
  curve.angle = std::atan2(end.dot(curve.e2), end.dot(curve.e1));
  if (curve.angle <= 0.0) curve.angle += 2.0 * std::numbers::pi;
  return curve;
}

}  // namespace

double Curve::length() const { return angle == 0.0 ? (to - from).norm() : radius * angle; }

Eigen::Vector3d Curve::at(double s) const {
  if (angle == 0.0) return from + s * (to - from);
  return center + radius * (std::cos(s * angle) * e1 + std::sin(s * angle) * e2);
}

Curve curve_of(const formats::BeamLine& line, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  if (!((to - from).norm() > 1e-12 * (1.0 + from.norm() + to.norm())))
    throw Error(fmt::format("beam '{}' has zero length: its ends are at the same place", line.name), line.where,
                "move one of the points (a full circle is drawn as two arcs)");
  return line.through ? circle_arc(from, *line.through, to, line) : Curve{from, to};
}

int element_count(const Curve& curve, const formats::BeamLine& line) {
  int count = line.elements;
  if (count <= 0) {
    if (!(line.size > 0.0))
      throw Error(fmt::format("beam '{}' has neither a number of elements nor an element size", line.name), line.where,
                  "give `elements: 10` or `size: 0.1`");
    const double wanted = std::ceil(curve.length() / line.size * (1.0 - 1e-12));
    if (!(wanted <= 1e6))
      throw Error(fmt::format("beam '{}': size {} gives {:.3g} elements", line.name, line.size, wanted), line.where,
                  "use a larger size");
    count = std::max(1, static_cast<int>(wanted));
  }
  const int least = static_cast<int>(curve.angle / 2.0) + 1;
  if (count < least)
    throw Error(fmt::format("beam '{}': {} elements are too few for an arc of {:.0f} degrees", line.name, count,
                            curve.angle * 180.0 / std::numbers::pi),
                line.where, fmt::format("use at least {} elements", least));
  return count;
}

Eigen::Vector3d default_orientation(const std::vector<Eigen::Vector3d>& tangents) {
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& tangent : tangents) largest = largest.cwiseMax(tangent.cwiseAbs());
  int best = 1;
  for (const int axis : {2, 0})
    if (largest[axis] < largest[best] - 1e-9) best = axis;
  return Eigen::Vector3d::Unit(best);
}

}  // namespace tisserand::reducer

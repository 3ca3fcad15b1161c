// SPDX-License-Identifier: GPL-3.0-or-later
// Lines and arcs of beam bodies divided into equal elements with section triads.
#include "mechanism/bodies/beam/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Geometry>

#include "common/error.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::string text(const Vector3d& v) { return fmt::format("({:g}, {:g}, {:g})", v.x(), v.y(), v.z()); }

/// Arc length, positions and unit tangents of the nodes.
struct CenterLine {
  double length = 0.0;
  std::vector<Vector3d> position, tangent;
};

CenterLine line(const formats::BeamBodySpec& spec, int intervals) {
  CenterLine curve;
  const Vector3d axis = spec.to - spec.from;
  curve.length = axis.norm();
  if (!(curve.length > 0.0) || !std::isfinite(curve.length))
    throw Error(fmt::format("beam '{}' has zero length: from and to are both {}", spec.name, text(spec.from)),
                spec.where, "give two different points");
  for (int i = 0; i <= intervals; ++i) {
    curve.position.push_back(spec.from + axis * (static_cast<double>(i) / intervals));
    curve.tangent.push_back(axis / curve.length);
  }
  return curve;
}

/// Arc through three points; the radius vector from the center c turns about n by the angle, from `from` to `to`.
CenterLine arc(const formats::BeamBodySpec& spec, int intervals) {
  const Vector3d a = *spec.through - spec.from, b = spec.to - spec.from;
  const Vector3d normal = a.cross(b);
  const double area = normal.norm();  // twice the area of the triangle
  const double size = std::max({a.norm(), b.norm(), (a - b).norm()});
  if (!(area > 1e-9 * size * size))
    throw Error(
        fmt::format("the arc of beam '{}' is not defined: from {}, through {} and to {} lie on a line or coincide",
                    spec.name, text(spec.from), text(*spec.through), text(spec.to)),
        spec.where, "give three points of a circle, or remove 'through' for a straight beam");
  // From `from` to the center of the circle through 0, a, b: (|a|² b − |b|² a) × (a × b) / (2 |a × b|²).
  const Vector3d center = (a.squaredNorm() * b - b.squaredNorm() * a).cross(normal) * (0.5 / (area * area));
  const Vector3d start = -center;
  const Vector3d axis = normal / area;  // from–through–to is counterclockwise about a × b
  const double radius = start.norm();
  const Vector3d end = b - center;
  double angle = std::atan2(axis.dot(start.cross(end)), start.dot(end));
  if (angle <= 0.0) angle += 2.0 * std::numbers::pi;
  CenterLine curve;
  curve.length = radius * angle;
  for (int i = 0; i <= intervals; ++i) {
    const Vector3d arm = Eigen::AngleAxisd(angle * i / intervals, axis) * start;
    curve.position.push_back(spec.from + center + arm);
    curve.tangent.push_back(axis.cross(arm) / radius);
  }
  curve.position.front() = spec.from;
  curve.position.back() = spec.to;
  return curve;
}

/// Global axis that is most nearly normal to the chords of all elements (stride: node intervals per element).
Vector3d default_orientation(const CenterLine& curve, std::size_t stride) {
  Vector3d largest = Vector3d::Zero();
  for (std::size_t i = 0; i + stride < curve.position.size(); i += stride)
    largest = largest.cwiseMax((curve.position[i + stride] - curve.position[i]).normalized().cwiseAbs());
  int best = 1;
  for (const int axis : {2, 0})
    if (largest[axis] < largest[best] - 1e-9) best = axis;
  return Vector3d::Unit(best);
}

std::vector<Matrix3d> section_triads(const formats::BeamBodySpec& spec, const CenterLine& curve) {
  const Vector3d given = spec.orientation
                             ? *spec.orientation
                             : default_orientation(curve, static_cast<std::size_t>(spec.nodes_per_element - 1));
  if (!(given.norm() > 0.0) || !given.allFinite())
    throw Error(fmt::format("orientation of beam '{}' is {}, which has no direction", spec.name, text(given)),
                spec.where, "give a vector that is not parallel to the beam");
  const Vector3d direction = given.normalized();
  std::vector<Matrix3d> triads;
  for (const Vector3d& tangent : curve.tangent) {
    const Vector3d normal = direction - tangent * tangent.dot(direction);
    if (!(normal.norm() > 1e-6))
      throw Error(fmt::format("orientation {} of beam '{}' is parallel to the beam at {}", text(given), spec.name,
                              text(curve.position[triads.size()])),
                  spec.where, "give a vector that is nowhere parallel to the beam (for an arc: along its normal)");
    Matrix3d triad;
    triad << tangent, normal.normalized(), tangent.cross(normal.normalized());
    // Between neighbours the triad follows the tangent, unless the orientation vector crosses the tangent.
    if (!triads.empty() && triads.back().col(1).dot(triad.col(1)) < 0.5 * triads.back().col(0).dot(tangent))
      throw Error(
          fmt::format("orientation {} of beam '{}' turns the section over near {}, where it is nearly parallel to "
                      "the beam",
                      text(given), spec.name, text(curve.position[triads.size()])),
          spec.where, "give an orientation along the normal of the arc, or more elements");
    triads.push_back(triad);
  }
  return triads;
}

template <int N>
void add_elements(const formats::BeamBodySpec& spec, int first_node, const BeamMesh& mesh,
                  std::vector<BeamElement<N>>& elements) {
  for (int k = 0; k < spec.elements; ++k) {
    BeamReference<N> reference;
    reference.length = mesh.length / spec.elements;
    for (int i = 0; i < N; ++i) {
      const int node = k * (N - 1) + i;
      reference.nodes[i] = first_node + node;
      reference.position[i] = mesh.position[node];
      reference.section[i] = mesh.section[node];
    }
    elements.push_back(make_beam_element<N>(reference, spec.section, spec.material));
  }
}

}  // namespace

BeamMesh mesh_beam(const formats::BeamBodySpec& spec, int first_node) {
  if (spec.elements < 1)
    throw Error(fmt::format("beam '{}' has {} elements", spec.name, spec.elements), spec.where, "give one or more");
  if (spec.nodes_per_element != 2 && spec.nodes_per_element != 3)
    throw Error(fmt::format("beam '{}' has {} nodes per element", spec.name, spec.nodes_per_element), spec.where,
                "give 2 or 3");
  const int intervals = spec.elements * (spec.nodes_per_element - 1);
  const CenterLine curve = spec.through ? arc(spec, intervals) : line(spec, intervals);
  BeamMesh mesh;
  mesh.length = curve.length;
  mesh.section = section_triads(spec, curve);
  mesh.position = curve.position;
  if (spec.nodes_per_element == 2)
    add_elements<2>(spec, first_node, mesh, mesh.elements2);
  else
    add_elements<3>(spec, first_node, mesh, mesh.elements3);
  return mesh;
}

}  // namespace tisserand::mechanism

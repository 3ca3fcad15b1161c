// SPDX-License-Identifier: GPL-3.0-or-later
// Entities in boxes and on bores, and nearest entities.
#include "reducer/sources/group_geometry.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;

double extent(const MeshBuilder& builder) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vector3d& x : builder.cells.position) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return builder.cells.position.empty() ? 0.0 : (high - low).norm();
}

using Holds = std::function<bool(const Vector3d&)>;

Holds in_box(const formats::BoxSelection& box, double tolerance) {
  const Vector3d low = box.low.array() - tolerance, high = box.high.array() + tolerance;
  return
      [low, high](const Vector3d& x) { return (x.array() >= low.array()).all() && (x.array() <= high.array()).all(); };
}

Holds on_cylinder(const formats::CylinderSelection& cylinder, double tolerance) {
  const Vector3d axis = cylinder.to - cylinder.from, n = axis.normalized();
  return [=](const Vector3d& x) {
    const double along = (x - cylinder.from).dot(n);
    const double radius = (x - cylinder.from - along * n).norm();
    return along >= -tolerance && along <= axis.norm() + tolerance && std::abs(radius - cylinder.radius) <= tolerance;
  };
}

/// Whether `holds` is true for all corners of the entity's cells.
bool lies(const MeshBuilder& builder, const Entity& entity, const Holds& holds) {
  const auto& cells = builder.cells.cells[entity.dimension];
  for (std::size_t c = entity.first; c < entity.first + entity.count; ++c)
    for (const int node : corners_of(cells[c]))
      if (!holds(builder.position(node))) return false;
  return entity.count > 0;
}

double to_segment(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
  const double s = (b - a).squaredNorm() > 0.0 ? std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0) : 0.0;
  return (x - a - s * (b - a)).norm();
}

double to_triangle(const Vector3d& x, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  const double area = n.squaredNorm();
  if (area > 0.0 && (b - a).cross(x - a).dot(n) >= 0.0 && (c - b).cross(x - b).dot(n) >= 0.0 &&
      (a - c).cross(x - c).dot(n) >= 0.0)
    return std::abs((x - a).dot(n)) / std::sqrt(area);
  return std::min({to_segment(x, a, b), to_segment(x, b, c), to_segment(x, c, a)});
}

/// Distance from a point to an edge or face; to the nearest corner of a volume.
double to_cell(const MeshBuilder& builder, const Cell& cell, const Vector3d& x) {
  const auto at = [&](int k) { return builder.position(cell.nodes[k]); };
  const CellForm form = form_of(cell.shape);
  if (form.dimension == 1) return to_segment(x, at(0), at(1));
  if (form.dimension == 2 && form.corners == 3) return to_triangle(x, at(0), at(1), at(2));
  if (form.dimension == 2) return std::min(to_triangle(x, at(0), at(1), at(2)), to_triangle(x, at(0), at(2), at(3)));
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < form.corners; ++k) least = std::min(least, (at(k) - x).norm());
  return least;
}

}  // namespace

std::pair<std::vector<int>, std::vector<int>> inside(const MeshBuilder& builder,
                                                     const formats::GroupDefinition& group) {
  const int dimension = static_cast<int>(group.of);
  std::vector<Holds> tests;
  if (group.box) tests.push_back(in_box(*group.box, group.tolerance.value_or(1e-6 * extent(builder))));
  if (group.cylinder)
    tests.push_back(on_cylinder(*group.cylinder, group.tolerance.value_or(1e-3 * group.cylinder->radius)));
  std::pair<std::vector<int>, std::vector<int>> found;
  for (const Holds& holds : tests) {
    if (dimension == 0) {
      for (int n = 0; n < std::ssize(builder.used); ++n)
        if (builder.used[n] != 0 && holds(builder.cells.position[n])) found.second.push_back(n);
      continue;
    }
    for (int e = 0; e < std::ssize(builder.cells.entities); ++e)
      if (builder.cells.entities[e].dimension == dimension && lies(builder, builder.cells.entities[e], holds))
        found.first.push_back(e);
  }
  return found;
}

int nearest_entity(const MeshBuilder& builder, const formats::GroupDefinition& group, const User& user) {
  const int dimension = static_cast<int>(group.of);
  NearestTwo found;
  for (int e = 0; e < std::ssize(builder.cells.entities); ++e) {
    const Entity& entity = builder.cells.entities[e];
    if (entity.dimension != dimension) continue;
    double own = std::numeric_limits<double>::infinity();
    const auto& cells = builder.cells.cells[dimension];
    for (std::size_t c = entity.first; c < entity.first + entity.count; ++c)
      own = std::min(own, to_cell(builder, cells[c], *group.near));
    found.look_at(e, own);
  }
  const double size = extent(builder), allowed = group.tolerance.value_or(0.1 * size);
  const auto name = [&](int e) { return name_of(builder.cells.entities[e]); };
  if (found.best < 0)
    throw Error(fmt::format("{}: there are no {}s", user.name, dimension_word(dimension)), user.where, "");
  if (found.distance > allowed)
    throw Error(fmt::format("{}: the nearest is {}, {:.3g} away; the tolerance is {:.3g}", user.name, name(found.best),
                            found.distance, allowed),
                user.where, "correct the position, or give a larger tolerance");
  if (found.is_ambiguous(size))
    throw Error(fmt::format("{}: {} and {} are equally near", user.name, name(found.best), name(found.second)),
                user.where, "move the position into one of them, or give its number");
  return found.best;
}

}  // namespace tisserand::reducer

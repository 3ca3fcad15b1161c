// SPDX-License-Identifier: GPL-3.0-or-later
// Form, side, area and middle of faces from cells and samples.
#include "reducer/faces/face_facts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;

constexpr double exact_tolerance = 1e-6, mesh_tolerance = 1e-4, rounding = 1e-6;  // of sizes; of coordinates
constexpr double exact_angle = 1e-3, guess_angle = 0.5;                           // rad
constexpr double most_turn = 52.0 * std::numbers::pi / 180.0;                     // of one cell
constexpr std::size_t least_normals = 3;

/// Normal of a cell times its area, by the right-hand rule of the corners.
Vector3d area_vector(const Cell& cell, const Positions& x) {
  const auto at = [&](int k) { return x[cell.nodes[k]]; };
  if (form_of(cell.shape).corners == 3) return 0.5 * (at(1) - at(0)).cross(at(2) - at(0));
  return 0.5 * (at(2) - at(0)).cross(at(3) - at(1));
}

SurfaceSamples samples_of(const FaceCells& face, const Positions& x) {
  SurfaceSamples samples;
  std::set<int> corners;
  for (const Cell& cell : face.cells) {
    const Vector3d area = area_vector(cell, x);
    if (!(area.norm() > 0.0)) continue;
    samples.place.push_back(middle_of(cell, x));
    samples.normal.push_back(area.normalized());
    corners.insert(corners_of(cell).begin(), corners_of(cell).end());
  }
  for (const int node : corners) samples.point.push_back(x[node]);
  samples.angle = guess_angle;
  return samples;
}

struct Extent {
  double size = 0.0, largest = 0.0;
};

Extent extent_of(const Positions& points) {
  Vector3d low = points.front(), high = low;
  double largest = 0.0;
  for (const Vector3d& x : points)
    low = low.cwiseMin(x), high = high.cwiseMax(x), largest = std::max(largest, x.cwiseAbs().maxCoeff());
  return {(high - low).norm(), largest};
}

/// Largest angle between normals of the form at the corners of one cell.
double turn_of(const Cell& cell, const Positions& x, const SurfaceForm& form) {
  const int corners = form_of(cell.shape).corners;
  double least = 1.0;
  for (int a = 0; a < corners; ++a)
    for (int b = 0; b < a; ++b)
      least = std::min(least, normal_at(form, x[cell.nodes[a]]).dot(normal_at(form, x[cell.nodes[b]])));
  return std::acos(std::clamp(least, -1.0, 1.0));
}

/// Whether the facets follow the form within the limits of their size, and are enough.
bool facets_follow(const FaceCells& face, const Positions& x, const SurfaceForm& form) {
  double turn = 0.0;
  for (const Cell& cell : face.cells) turn = std::max(turn, turn_of(cell, x, form));
  if (turn > most_turn) return false;
  Positions different;
  for (const Cell& cell : face.cells) {
    const Vector3d area = area_vector(cell, x);
    if (!(area.norm() > 0.0)) continue;
    const Vector3d n = area.normalized();
    if (std::abs(n.dot(normal_at(form, middle_of(cell, x)))) < std::cos(0.5 * turn + exact_angle)) return false;
    const double near = std::cos(0.25 * turn);
    const auto is_near = [&](const Vector3d& other) { return std::abs(other.dot(n)) > near; };
    if (different.size() < least_normals && std::ranges::none_of(different, is_near)) different.push_back(n);
  }
  return different.size() >= least_normals;
}

SurfaceForm form_of_cells(const FaceCells& face, const Positions& x) {
  SurfaceSamples samples = samples_of(face, x);
  if (samples.point.empty()) return {};
  const Extent extent = extent_of(samples.point);
  samples.tolerance = mesh_tolerance * extent.size + rounding * extent.largest;
  const SurfaceForm form = fitted_form(samples);
  const bool is_plain = form.kind == FormKind::plane || form.kind == FormKind::curved;
  return is_plain || facets_follow(face, x, form) ? form : SurfaceForm{};
}

SurfaceForm form_of_samples(const Positions& point, const Positions& normal) {
  SurfaceSamples samples{point, point, normal, 0.0, exact_angle};
  samples.tolerance = exact_tolerance * extent_of(point).size;
  return fitted_form(samples);
}

/// Chooses one point and one direction of the axis among those that describe the same form.
void settle(SurfaceForm& form, const Vector3d& center) {
  if (form.kind == FormKind::plane) form.point = center;
  if (form.kind == FormKind::cylinder) form.point += (center - form.point).dot(form.axis) * form.axis;
  if (form.kind != FormKind::cylinder && form.kind != FormKind::torus) return;
  Eigen::Index largest = 0;
  // Among equal components the first one counts, also after round-off.
  (form.axis.cwiseAbs() - Vector3d(0.0, 1e-9, 2e-9)).maxCoeff(&largest);
  if (form.axis[largest] < 0.0) form.axis = -form.axis;
}

}  // namespace

FaceFacts face_facts(const FaceCells& face, const Positions& position, const EntityGeometry& exact) {
  FaceFacts facts;
  if (face.cells.empty()) return facts;
  facts.form = exact.point.empty() ? form_of_cells(face, position) : form_of_samples(exact.point, exact.normal);
  double out = 0.0;
  bool is_known = true;
  for (std::size_t c = 0; c < face.cells.size(); ++c) {
    const Vector3d area = area_vector(face.cells[c], position), middle = middle_of(face.cells[c], position);
    facts.area += area.norm();
    facts.center += area.norm() * middle;
    const int sign = face.sign[c];
    is_known = is_known && sign != 0;
    out += (sign < 0 ? -1.0 : 1.0) * area.dot(normal_at(facts.form, middle));
  }
  if (facts.area > 0.0) facts.center /= facts.area;
  const bool is_clear = is_known && std::abs(out) > 0.5 * facts.area;
  if (facts.form.kind == FormKind::plane) {
    if (out < 0.0) facts.form.axis = -facts.form.axis;
    facts.is_outward = is_clear;
  } else if (facts.form.kind != FormKind::curved && is_clear) {
    facts.side = out > 0.0 ? FaceSide::convex : FaceSide::concave;
  }
  if (exact.size > 0.0) facts.area = exact.size, facts.center = exact.center;
  settle(facts.form, facts.center);
  return facts;
}

}  // namespace tisserand::reducer

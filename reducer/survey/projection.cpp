// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles sorted by depth, and squares of the picture that find the triangles in front of a place.
#include "reducer/survey/projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>

namespace tisserand::reducer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;

constexpr double crease = 0.77;         // cosine of 40 degrees: at sharper edges facets keep their own normals
constexpr double longest_side = 24.0;   // pixels: larger triangles are painted in parts
constexpr double square = 16.0;         // pixels
constexpr double same_depth = 1.5;      // pixels within which a place does not hide another
constexpr double edge_in_front = 20.0;  // pixels by which an edge is in front of the middles of adjacent triangles
constexpr double half_width_of_edge = 0.7, overlap_of_facets = 0.6;  // pixels
constexpr double longest_miter = 2.0;                                // pixels
constexpr std::array<double, 3> edge_colour{0.2, 0.2, 0.2};
constexpr std::size_t most_middles = 400;  // of cells of one surface

Vector3d facet_normal(const Cell& cell, const Positions& x) {
  const auto at = [&](int k) { return x[cell.nodes[k]]; };
  return form_of(cell.shape).corners == 3 ? (at(1) - at(0)).cross(at(2) - at(0)) : (at(2) - at(0)).cross(at(3) - at(1));
}

/// Mean normal of the facets around each corner, weighted by area.
std::unordered_map<int, Vector3d> node_normals(const ColouredSurface& surface, const Positions& x) {
  std::unordered_map<int, Vector3d> sums;
  for (const Cell& cell : surface.cells)
    for (const int node : corners_of(cell))
      sums.try_emplace(node, Vector3d::Zero()).first->second += facet_normal(cell, x);
  return sums;
}

/// Brightness from a lamp at the upper left and from diffuse light; both sides of a surface are lit alike.
double light_of(const Vector3d& normal) {
  static const Vector3d lamp = Vector3d(-0.35, 0.55, 0.75).normalized();
  const Vector3d n = (normal.z() < 0.0 ? -1.0 : 1.0) * normal.normalized();
  return 0.74 + 0.30 * std::max(0.0, n.dot(lamp));
}

/// Depth of a triangle at a point; -infinity outside of it.
double depth_at(const std::array<Vector3d, 3>& x, const Vector2d& p) {
  const Vector2d a = x[0].head<2>(), b = x[1].head<2>(), c = x[2].head<2>();
  const auto twice = [](const Vector2d& u, const Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); };
  const double area = twice(b - a, c - a);
  if (std::abs(area) < 1e-9) return -std::numeric_limits<double>::infinity();
  const double u = twice(b - p, c - p) / area, v = twice(c - p, a - p) / area, w = 1.0 - u - v;
  if (u < -1e-9 || v < -1e-9 || w < -1e-9) return -std::numeric_limits<double>::infinity();
  return u * x[0].z() + v * x[1].z() + w * x[2].z();
}

double to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double square_length = along.squaredNorm();
  const double share = square_length > 0.0 ? std::clamp((p - a).dot(along) / square_length, 0.0, 1.0) : 0.0;
  return (p - a - share * along).norm();
}

/// Polygon with its depth.
using Painted = std::pair<double, PaintedPolygon>;

/// Triangle with its sides moved outwards, so that no seam is visible between neighbours.
std::vector<Vector2d> grown(const std::array<Vector3d, 3>& x) {
  std::array<Vector2d, 3> out;  // side k, from corner k to the next
  const Vector2d center = (x[0] + x[1] + x[2]).head<2>() / 3.0;
  for (int k = 0; k < 3; ++k) {
    const Vector2d along = (x[(k + 1) % 3] - x[k]).head<2>();
    out[k] = Vector2d(along.y(), -along.x()) / std::max(along.norm(), 1e-9);
    if (out[k].dot(x[k].head<2>() - center) < 0.0) out[k] = -out[k];
  }
  std::vector<Vector2d> corners;
  for (int k = 0; k < 3; ++k) {
    const Vector2d &before = out[(k + 2) % 3], &after = out[k];
    const Vector2d miter = overlap_of_facets * (before + after) / std::max(1.0 + before.dot(after), 1e-3);
    corners.push_back(x[k].head<2>() + miter * std::min(1.0, longest_miter / std::max(miter.norm(), 1e-9)));
  }
  return corners;
}

/// Paints a triangle in small parts.
void paint(const std::array<Vector3d, 3>& x, const std::array<double, 3>& colour, std::vector<Painted>& painted) {
  int longest = 0;
  double length = 0.0;
  for (int k = 0; k < 3; ++k)
    if (const double side = (x[(k + 1) % 3] - x[k]).norm(); side > length) length = side, longest = k;
  if (length > longest_side) {
    const Vector3d &a = x[longest], &b = x[(longest + 1) % 3], &c = x[(longest + 2) % 3], middle = 0.5 * (a + b);
    paint({a, middle, c}, colour, painted);
    paint({middle, b, c}, colour, painted);
    return;
  }
  painted.emplace_back((x[0].z() + x[1].z() + x[2].z()) / 3.0, PaintedPolygon{grown(x), colour});
}

/// Paints the parts of an edge whose middles are visible.
void paint_edge(const Vector3d& a, const Vector3d& b, const auto& is_hidden, std::vector<Painted>& painted) {
  const int parts = std::max(1, static_cast<int>(std::ceil((b - a).norm() / (0.25 * longest_side))));
  for (int k = 0; k < parts; ++k) {
    const Vector3d p = a + (b - a) * k / parts, q = a + (b - a) * (k + 1) / parts;
    const Vector2d along = (q - p).head<2>();
    if (!(along.norm() > 1e-9) || is_hidden(Vector3d(0.5 * (p + q)))) continue;
    const Vector2d aside = half_width_of_edge * Vector2d(-along.y(), along.x()).normalized(), s = p.head<2>(),
                   t = q.head<2>();
    painted.emplace_back(0.5 * (p.z() + q.z()) + edge_in_front,
                         PaintedPolygon{{s - aside, t - aside, t + aside, s + aside}, edge_colour});
  }
}

}  // namespace

PictureView view_from(const Vector3d& eye, const Positions& position, int width, int height) {
  PictureView view;
  const Vector3d towards = eye.normalized();
  const Vector3d right = Vector3d::UnitZ().cross(towards).normalized();
  view.R_VW << right.transpose(), towards.cross(right).transpose(), towards.transpose();
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vector3d& x : position) {
    const Vector2d flat = (view.R_VW * x).head<2>();
    low = low.cwiseMin(flat);
    high = high.cwiseMax(flat);
  }
  constexpr double share = 0.88;
  const Vector2d extent = (high - low).cwiseMax(1e-12 * (1.0 + high.norm()));
  view.pixel = std::max(extent.x() / (share * width), extent.y() / (share * height));
  view.low = 0.5 * (low + high) - 0.5 * view.pixel * Vector2d(width, height);
  return view;
}

PictureProjection::PictureProjection(const std::vector<ColouredSurface>& surfaces, const Positions& position,
                                     const PictureView& view, int width, int height)
    : width_(width), height_(height), columns_(static_cast<int>(std::ceil(width / square))) {
  for (int s = 0; s < std::ssize(surfaces); ++s) add(surfaces[s], s, position, view);
  const int rows = static_cast<int>(std::ceil(height / square));
  buckets_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
  const auto cell = [](double pixel, int count) {
    return std::clamp(static_cast<int>(std::floor(pixel / square)), 0, count - 1);
  };
  for (int t = 0; t < std::ssize(triangles_); ++t) {
    const auto& x = triangles_[t].x;
    const auto [left, right] = std::minmax({x[0].x(), x[1].x(), x[2].x()});
    const auto [top, bottom] = std::minmax({x[0].y(), x[1].y(), x[2].y()});
    for (int row = cell(top, rows); row <= cell(bottom, rows); ++row)
      for (int column = cell(left, columns_); column <= cell(right, columns_); ++column)
        buckets_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)]
            .push_back(t);
  }
}

void PictureProjection::add(const ColouredSurface& surface, int number, const Positions& position,
                            const PictureView& view) {
  colour_.push_back(surface.colour);
  middles_.emplace_back();
  const auto projected = [&](int node) {
    const Vector3d x = view.R_VW * position[node];
    return Vector3d((x.x() - view.low.x()) / view.pixel, height_ - (x.y() - view.low.y()) / view.pixel,
                    x.z() / view.pixel);
  };
  const std::unordered_map<int, Vector3d> normals = node_normals(surface, position);
  std::map<std::pair<int, int>, int> sides;
  const std::size_t step = 1 + surface.cells.size() / most_middles;
  for (std::size_t c = 0; c < surface.cells.size(); ++c) {
    const Cell& cell = surface.cells[c];
    const int corners = form_of(cell.shape).corners;
    const Vector3d facet = facet_normal(cell, position).normalized();
    Vector3d normal = Vector3d::Zero(), middle = Vector3d::Zero();
    for (int k = 0; k < corners; ++k) {
      const Vector3d mean = normals.at(cell.nodes[k]).normalized();
      normal += std::abs(mean.dot(facet)) > crease ? mean : facet;
      middle += projected(cell.nodes[k]) / corners;
      ++sides[std::minmax({cell.nodes[k], cell.nodes[(k + 1) % corners]})];
    }
    if (c % step == 0) middles_.back().push_back(middle);
    for (int k = 2; k < corners; ++k)
      triangles_.push_back({{projected(cell.nodes[0]), projected(cell.nodes[k - 1]), projected(cell.nodes[k])},
                            light_of(view.R_VW * normal),
                            number});
  }
  for (const auto& [side, count] : sides)
    if (count == 1) rims_.push_back({projected(side.first), projected(side.second), number});
}

std::vector<PaintedPolygon> PictureProjection::polygons() const {
  std::vector<Painted> painted;
  const auto seen = [this](const std::array<Vector3d, 3>& x) {
    return !(is_hidden((x[0] + x[1] + x[2]) / 3.0) && is_hidden(x[0]) && is_hidden(x[1]) && is_hidden(x[2]));
  };
  for (const Triangle& triangle : triangles_) {
    if (!seen(triangle.x)) continue;
    std::array<double, 3> colour = colour_[triangle.surface];
    for (double& part : colour) part = std::min(1.0, part * triangle.light);
    paint(triangle.x, colour, painted);
  }
  for (const Segment& rim : rims_)
    paint_edge(
        rim.a, rim.b, [this](const Vector3d& place) { return is_hidden(place); }, painted);
  std::vector<std::size_t> order(painted.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, [&](std::size_t i, std::size_t j) {
    return std::pair(painted[i].first, i) < std::pair(painted[j].first, j);
  });
  std::vector<PaintedPolygon> polygons;
  for (const std::size_t i : order) polygons.push_back(std::move(painted[i].second));
  return polygons;
}

const std::vector<int>& PictureProjection::near(const Vector2d& at) const {
  static const std::vector<int> none;
  if (at.x() < 0.0 || at.y() < 0.0 || at.x() >= width_ || at.y() >= height_) return none;
  const auto row = static_cast<std::size_t>(at.y() / square), column = static_cast<std::size_t>(at.x() / square);
  return buckets_[row * static_cast<std::size_t>(columns_) + column];
}

bool PictureProjection::is_hidden(const Vector3d& place) const {
  return std::ranges::any_of(near(place.head<2>()), [&](int t) {
    return depth_at(triangles_[t].x, place.head<2>()) > place.z() + same_depth;
  });
}

bool PictureProjection::covers(const Vector2d& at) const {
  return std::ranges::any_of(near(at), [&](int t) { return std::isfinite(depth_at(triangles_[t].x, at)); });
}

std::vector<SeenPlace> PictureProjection::seen_places() const {
  std::vector<SeenPlace> places(middles_.size());
  for (int s = 0; s < std::ssize(middles_); ++s) {
    std::vector<Vector2d> seen, hidden;
    for (const Vector3d& middle : middles_[s]) (is_hidden(middle) ? hidden : seen).push_back(middle.head<2>());
    for (const Vector2d& place : seen) {
      double radius = std::numeric_limits<double>::infinity();
      for (const Segment& rim : rims_)
        if (rim.surface == s) radius = std::min(radius, to_segment(place, rim.a.head<2>(), rim.b.head<2>()));
      for (const Vector2d& other : hidden) radius = std::min(radius, (place - other).norm());
      if (radius > places[s].radius) places[s] = {place, std::min(radius, static_cast<double>(width_))};
    }
  }
  return places;
}

}  // namespace tisserand::reducer

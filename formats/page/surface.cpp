// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulates the solids of a scene.
#include "formats/page/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "formats/page/skin.hpp"
#include "formats/sections/profiles.hpp"
#include "formats/surface/surface_file.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int around = 24;  // corners of a circle
constexpr double turn = 2.0 * std::numbers::pi;

Outline ellipse(double half_y, double half_z) {
  Outline outline;
  for (int k = 0; k < around; ++k)
    outline.emplace_back(half_y * std::cos(turn * k / around), half_z * std::sin(turn * k / around));
  return outline;
}

Outline rectangle(double width, double height) {
  const double y = 0.5 * width, z = 0.5 * height;
  return {{-y, -z}, {y, -z}, {y, z}, {-y, z}};
}

double signed_area(const Outline& outline) {
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

Surface box(const Vector3d& size) {
  Surface surface;
  for (int k = 0; k < 8; ++k)
    surface.vertices.emplace_back(
        size.cwiseProduct(Vector3d(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5)));
  surface.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return surface;
}

/// Tube of circles with the given radii along a polyline. The plane at a corner bisects the angle.
Surface tube(const std::vector<Vector3d>& points, const std::vector<double>& radii) {
  Surface surface = swept_faces(count_of(points), around);
  Vector3d y = (points[1] - points[0]).unitOrthogonal();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d before =
        i > 0 ? (points[i] - points[i - 1]).normalized() : Vector3d(points[1] - points[0]).normalized();
    const Vector3d after = i + 1 < points.size() ? (points[i + 1] - points[i]).normalized() : before;
    const Vector3d sum = before + after;
    const Vector3d x = sum.norm() > 1e-6 ? Vector3d(sum.normalized()) : before;
    y = y - x.dot(y) * x;
    y = y.norm() > 1e-9 ? Vector3d(y.normalized()) : x.unitOrthogonal();
    const Vector3d z = x.cross(y);
    for (int k = 0; k < around; ++k)
      surface.vertices.push_back(points[i] +
                                 radii[i] * (std::cos(turn * k / around) * y + std::sin(turn * k / around) * z));
  }
  return surface;
}

/// Surface of a part, in lengths of the scene.
Surface of_recovery(const ShapeSpec& shape) {
  const RecoveryReader reader(shape.file);
  Surface surface = skin_of(reader.recovery()).surface;
  const double length = convert_units(reader.recovery().units, shape.units, shape.file).length;
  for (Vector3d& vertex : surface.vertices) vertex *= length;
  return surface;
}

Surface of_triangles(const std::string& path) {
  TriangleSurface file = read_surface_file(path);
  return {std::move(file.vertices), std::move(file.triangles), {}};
}

Surface of_file(const ShapeSpec& shape) {
  Surface surface = shape.file.ends_with(".recovery.h5") ? of_recovery(shape) : of_triangles(shape.file);
  for (Vector3d& vertex : surface.vertices) vertex = vertex.cwiseProduct(shape.scale);
  if (shape.scale.prod() < 0.0)
    for (std::array<int, 3>& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  return surface;
}

Surface placed(Surface surface, const ShapeSpec& shape) {
  for (Vector3d& vertex : surface.vertices) vertex = shape.position + shape.orientation * vertex;
  return surface;
}

}  // namespace

void Surface::add(const Surface& other) {
  const int first = size();
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const std::array<int, 3>& t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  for (const std::array<int, 2>& l : other.lines) lines.push_back({l[0] + first, l[1] + first});
}

Surface sphere(const Vector3d& center, double radius) {
  constexpr int rings = 11;
  std::vector<Vector3d> points;
  std::vector<double> radii;
  for (int i = 1; i <= rings; ++i) {
    const double angle = 0.5 * turn * i / (rings + 1);
    points.push_back(center - Vector3d(0.0, 0.0, radius * std::cos(angle)));
    radii.push_back(radius * std::sin(angle));
  }
  Surface surface = tube(points, radii);
  surface.triangles.resize(2 * around * (rings - 1));  // poles instead of flat ends
  const int south = surface.size(), north = south + 1, last = (rings - 1) * around;
  surface.vertices.push_back(center - Vector3d(0.0, 0.0, radius));
  surface.vertices.push_back(center + Vector3d(0.0, 0.0, radius));
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around;
    surface.triangles.push_back({south, next, k});
    surface.triangles.push_back({north, last + k, last + next});
  }
  return surface;
}

Surface surface_of(const ShapeSpec& shape) {
  switch (shape.kind) {
    case ShapeKind::box:
      return placed(box(shape.size), shape);
    case ShapeKind::sphere:
      return sphere(shape.position, shape.radius);
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      return tube({shape.from, shape.to}, {shape.radius, shape.end_radius});
    case ShapeKind::tube:
      return tube(shape.points, std::vector<double>(shape.points.size(), shape.radius));
    case ShapeKind::mesh:
      return placed(of_file(shape), shape);
  }
  return {};
}

Outline outline_of(const Section& s, double fallback) {
  Outline outline;
  const auto& sizes = s.sizes;
  if (s.shape == "circle" || s.shape == "hollow_circle") {
    outline = ellipse(sizes[0], sizes[0]);
  } else if (s.shape == "rectangle" || s.shape == "hollow_rectangle") {
    outline = rectangle(sizes[0], sizes[1]);
  } else if (find_profile(s.shape) != nullptr) {
    const SectionPolygon polygon = profile_polygon(s.shape, sizes);
    const Vector2d centroid = area_moments(polygon).centroid;
    for (const Vector2d& corner : polygon.outer) outline.emplace_back(corner - centroid);
  } else if (s.second_moment_y > 0.0 && s.second_moment_z > 0.0 && s.area > 0.0) {
    // A rectangle w x h has the radii of gyration w/sqrt(12), h/sqrt(12). By stiffness they follow from EI and EA.
    outline = rectangle(std::sqrt(12.0 * s.second_moment_z / s.area), std::sqrt(12.0 * s.second_moment_y / s.area));
  } else {
    const double radius = s.area > 0.0 && !s.by_stiffness ? std::sqrt(s.area / std::numbers::pi) : fallback;
    outline = ellipse(radius, radius);
  }
  for (Vector2d& corner : outline) corner += Vector2d(s.centroid_y, s.centroid_z);
  if (signed_area(outline) < 0.0) std::ranges::reverse(outline);
  return outline;
}

Surface swept_faces(int stations, int corners) {
  Surface surface;
  for (int i = 0; i + 1 < stations; ++i)
    for (int k = 0; k < corners; ++k) {
      const int a = i * corners + k, b = i * corners + (k + 1) % corners;
      surface.triangles.push_back({a, b, a + corners});
      surface.triangles.push_back({b, b + corners, a + corners});
    }
  const int last = (stations - 1) * corners;
  for (int k = 2; k < corners; ++k) {
    surface.triangles.push_back({0, k, k - 1});
    surface.triangles.push_back({last, last + k - 1, last + k});
  }
  return surface;
}

std::vector<std::array<int, 2>> least_tree(const std::vector<Vector3d>& points) {
  std::vector<std::array<int, 2>> lines;
  const int count = count_of(points);
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  std::vector<int> nearest(points.size(), 0);
  std::vector<bool> joined(points.size(), false);
  int last = 0;
  for (int n = 1; n < count; ++n) {  // Prim's algorithm
    joined[last] = true;
    int next = -1;
    for (int i = 0; i < count; ++i) {
      if (joined[i]) continue;
      const double d = (points[i] - points[last]).squaredNorm();
      if (d < distance[i]) distance[i] = d, nearest[i] = last;
      if (next < 0 || distance[i] < distance[next]) next = i;
    }
    lines.push_back({nearest[next], next});
    last = next;
  }
  return lines;
}

}  // namespace tisserand::formats

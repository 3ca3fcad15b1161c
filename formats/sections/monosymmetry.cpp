// SPDX-License-Identifier: GPL-3.0-or-later
// Integrates polynomials of third degree over triangles of a polygon.
#include "formats/sections/monosymmetry.hpp"

#include <cmath>
#include <cstddef>

#include "formats/sections/profiles.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Vector2d;

double doubled_area(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Signed integral ∫p |p|² dA of the triangle 0, a, b, with p = λ a + μ b, ∫λ³ = 2 T/20, ∫λ² μ = 2 T/60.
Vector2d triangle_moment(const Vector2d& a, const Vector2d& b) {
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const Vector2d pure = a * aa + b * bb, mixed = 2.0 * ab * (a + b) + b * aa + a * bb;
  return doubled_area(a, b) * (pure / 20.0 + mixed / 60.0);
}

/// Third moments of a ring about a point, positive for either orientation.
Vector2d ring_moment(const Ring& ring, const Vector2d& about) {
  Vector2d sum = Vector2d::Zero();
  double area = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d a = ring[i] - about, b = ring[(i + 1) % ring.size()] - about;
    sum += triangle_moment(a, b);
    area += doubled_area(a, b);
  }
  return area < 0.0 ? Vector2d(-sum) : sum;
}

/// Third moments of a straight wall, as a rectangle, about the centroid.
Vector2d wall_moment(const Vector2d& from, const Vector2d& to, double thickness, const Vector2d& centroid) {
  const Vector2d along = (to - from).normalized(), half = 0.5 * thickness * Vector2d(-along.y(), along.x());
  return ring_moment({from - half, to - half, to + half, from + half}, centroid);
}

Vector2d polygon_of_sizes(const std::vector<double>& sizes) {
  SectionPolygon polygon;
  for (std::size_t at = 0; at < sizes.size();) {
    Ring ring(static_cast<std::size_t>(sizes[at++]));
    for (Vector2d& corner : ring) {
      corner = {sizes[at], sizes[at + 1]};
      at += 2;
    }
    if (polygon.outer.empty())
      polygon.outer = ring;
    else
      polygon.holes.push_back(ring);
  }
  return third_moments(polygon);
}

Vector2d walls_of_sizes(const std::vector<double>& sizes) {
  std::vector<WallLine> lines;
  for (std::size_t at = 0; at + 5 <= sizes.size(); at += 5)
    lines.push_back({{{sizes[at], sizes[at + 1]}, {sizes[at + 2], sizes[at + 3]}}, sizes[at + 4]});
  return third_moments(lines);
}

}  // namespace

Vector2d third_moments(const SectionPolygon& polygon) {
  const Vector2d centroid = area_moments(polygon).centroid;
  Vector2d sum = ring_moment(polygon.outer, centroid);
  for (const Ring& hole : polygon.holes) sum -= ring_moment(hole, centroid);
  return sum;
}

Vector2d third_moments(const std::vector<WallLine>& lines) {
  const Vector2d centroid = walls_centroid(lines);
  Vector2d sum = Vector2d::Zero();
  for (const WallLine& line : lines)
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
      sum += wall_moment(line.points[i], line.points[i + 1], line.thickness, centroid);
  return sum;
}

std::optional<Vector2d> third_moments(const Section& s) {
  if (s.shape == "circle" || s.shape == "hollow_circle" || s.shape == "rectangle" || s.shape == "hollow_rectangle")
    return Vector2d(Vector2d::Zero());
  if (s.shape == "polygon") return polygon_of_sizes(s.sizes);
  if (s.shape == "walls") return walls_of_sizes(s.sizes);
  if (find_profile(s.shape) == nullptr) return std::nullopt;
  return third_moments(profile_polygon(s.shape, s.sizes));
}

void remember_outline(const SectionPolygon& polygon, Section& section) {
  section.shape = "polygon";
  section.sizes.clear();
  const auto add = [&section](const Ring& ring) {
    section.sizes.push_back(static_cast<double>(ring.size()));
    for (const Vector2d& corner : ring) section.sizes.insert(section.sizes.end(), {corner.x(), corner.y()});
  };
  add(polygon.outer);
  for (const Ring& hole : polygon.holes) add(hole);
}

void remember_outline(const std::vector<WallLine>& lines, Section& section) {
  section.shape = "walls";
  section.sizes.clear();
  for (const WallLine& line : lines)
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      const Vector2d &from = line.points[i], &to = line.points[i + 1];
      section.sizes.insert(section.sizes.end(), {from.x(), from.y(), to.x(), to.y(), line.thickness});
    }
}

Monosymmetry monosymmetry(const Section& s, const Vector2d& third) {
  constexpr double round_off = 1e-9;
  const double Iy = s.second_moment_y, Iz = s.second_moment_z, Iyz = s.second_moment_yz;
  const double determinant = Iy * Iz - Iyz * Iyz;
  if (!(determinant > 0.0)) return {};
  // σ = a y + b z: M_y = b Iy + a Iyz, −M_z = b Iyz + a Iz.
  const double of_y = (third.y() * Iz - third.x() * Iyz) / determinant - 2.0 * s.shear_center_z;
  const double of_z = (third.x() * Iy - third.y() * Iyz) / determinant - 2.0 * s.shear_center_y;
  const double radius = s.area > 0.0 ? std::sqrt((Iy + Iz) / s.area) : 0.0;
  const auto kept = [radius](double beta) { return std::abs(beta) < round_off * radius ? 0.0 : beta; };
  return {kept(of_y), kept(of_z)};
}

Monosymmetry known_monosymmetry(const Section& section) {
  return monosymmetry(section, third_moments(section).value_or(Vector2d::Zero()));
}

bool lacks_monosymmetry(const Section& s) {
  const bool oblique = s.shear_center_y != 0.0 || s.shear_center_z != 0.0 || s.second_moment_yz != 0.0;
  return oblique && s.shape != "rod" && !third_moments(s);
}

}  // namespace tisserand::formats

// SPDX-License-Identifier: GPL-3.0-or-later
// Area moments and faults of polygons, and the Section of a polygon.
#include "formats/sections/polygon.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "formats/sections/flow.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double signed_area(const Ring& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  return 0.5 * twice;
}

struct Moments {
  double area = 0.0;
  Vector2d first = Vector2d::Zero();
  double yy = 0.0, zz = 0.0, yz = 0.0;
};

/// Adds the moments of the ring about `origin` with the weight `sign`, for either orientation.
void add_ring(const Ring& ring, const Vector2d& origin, double sign, Moments& sum) {
  const double sense = signed_area(ring) < 0.0 ? -sign : sign;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d a = ring[i] - origin, b = ring[(i + 1) % ring.size()] - origin;
    const double c = sense * cross(a, b);
    sum.area += c / 2.0;
    sum.first += c / 6.0 * (a + b);
    sum.yy += c / 12.0 * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x());
    sum.zz += c / 12.0 * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y());
    sum.yz += c / 24.0 * (2.0 * a.x() * a.y() + a.x() * b.y() + b.x() * a.y() + 2.0 * b.x() * b.y());
  }
}

Moments moments_about(const SectionPolygon& polygon, const Vector2d& origin) {
  Moments sum;
  add_ring(polygon.outer, origin, 1.0, sum);
  for (const Ring& hole : polygon.holes) add_ring(hole, origin, -1.0, sum);
  return sum;
}

/// Smallest distance between the segments ab and cd, or 0 if they cross.
double segment_distance(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const auto side = [](const Vector2d& p, const Vector2d& q, const Vector2d& r) { return cross(q - p, r - p); };
  if (side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0) return 0.0;
  const auto to_segment = [](const Vector2d& p, const Vector2d& q, const Vector2d& r) {
    const double t = std::clamp((p - q).dot(r - q) / (r - q).squaredNorm(), 0.0, 1.0);
    return (p - q - t * (r - q)).norm();
  };
  return std::min({to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
}

bool inside(const Vector2d& p, const Ring& ring) {
  bool in = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      in = !in;
  }
  return in;
}

struct Side {
  Vector2d from, to;
  std::size_t ring = 0, index = 0, count = 0;  ///< position in its ring; number of sides of the ring
};

std::string point_text(const Vector2d& p) { return fmt::format("({:g}, {:g})", p.x(), p.y()); }

std::vector<Side> all_sides(const std::vector<const Ring*>& rings) {
  std::vector<Side> sides;
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r]->size(); ++i)
      sides.push_back({(*rings[r])[i], (*rings[r])[(i + 1) % rings[r]->size()], r, i, rings[r]->size()});
  return sides;
}

/// Fault of sides that touch or cross without being neighbours, or of neighbours that fold back onto each other.
std::optional<std::string> crossing(const std::vector<Side>& sides, double size) {
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      const Side &a = sides[i], &b = sides[j];
      if (a.ring == b.ring && (a.index + 1 == b.index || (a.index == 0 && b.index + 1 == b.count))) {
        const Side &first = a.index + 1 == b.index ? a : b, &second = a.index + 1 == b.index ? b : a;
        const Vector2d u = first.from - first.to, v = second.to - second.from;
        if (u.dot(v) > 0.0 && std::abs(cross(u, v)) < 1e-9 * u.norm() * v.norm())
          return fmt::format("the sides at the corner {} fold back onto each other", point_text(first.to));
        continue;
      }
      if (segment_distance(a.from, a.to, b.from, b.to) < 1e-9 * size)
        return fmt::format("the side from {} to {} touches or crosses the side from {} to {}", point_text(a.from),
                           point_text(a.to), point_text(b.from), point_text(b.to));
    }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> polygon_fault(const SectionPolygon& polygon) {
  std::vector<const Ring*> rings{&polygon.outer};
  for (const Ring& hole : polygon.holes) rings.push_back(&hole);
  std::size_t corners = 0;
  double size = 0.0;
  for (const Ring* ring : rings) {
    if (ring->size() < 3) return fmt::format("{} corners do not enclose an area", ring->size());
    corners += ring->size();
    for (const Vector2d& p : *ring) {
      if (!p.allFinite()) return "a corner is not a finite number";
      size = std::max(size, (p - polygon.outer[0]).norm());
    }
  }
  if (corners > largest_polygon) return fmt::format("{} corners exceed the limit of {}", corners, largest_polygon);
  for (const Ring* ring : rings)
    for (std::size_t i = 0; i < ring->size(); ++i)
      if (!(((*ring)[i] - (*ring)[(i + 1) % ring->size()]).norm() > 1e-9 * size))
        return fmt::format("two neighbouring corners coincide at {}", point_text((*ring)[i]));
  if (auto text = crossing(all_sides(rings), size)) return text;
  for (std::size_t h = 0; h < polygon.holes.size(); ++h) {
    if (!inside(polygon.holes[h][0], polygon.outer)) return fmt::format("hole {} is not inside the outline", h + 1);
    for (std::size_t other = 0; other < polygon.holes.size(); ++other)
      if (other != h && inside(polygon.holes[h][0], polygon.holes[other]))
        return fmt::format("hole {} is inside hole {}", h + 1, other + 1);
  }
  return std::nullopt;
}

AreaMoments area_moments(const SectionPolygon& polygon) {
  const Moments rough = moments_about(polygon, polygon.outer[0]);
  AreaMoments result;
  result.centroid = polygon.outer[0] + rough.first / rough.area;
  const Moments fine = moments_about(polygon, result.centroid);
  result.area = fine.area;
  result.second_moment_y = fine.zz;
  result.second_moment_z = fine.yy;
  result.second_moment_yz = fine.yz;
  return result;
}

Section polygon_section(const SectionPolygon& polygon) {
  const AreaMoments moments = area_moments(polygon);
  const SaintVenant flow = saint_venant(polygon);
  Section section;
  section.area = moments.area;
  section.second_moment_y = moments.second_moment_y;
  section.second_moment_z = moments.second_moment_z;
  section.second_moment_yz = moments.second_moment_yz;
  section.polar_moment = moments.second_moment_y + moments.second_moment_z;
  section.torsion_constant = flow.torsion_constant;
  section.shear_area_y = 1.0 / flow.shear_compliance(0, 0);
  section.shear_area_z = 1.0 / flow.shear_compliance(1, 1);
  section.shear_coupling = flow.shear_compliance(0, 1);
  section.shear_center_y = flow.shear_center.x();
  section.shear_center_z = flow.shear_center.y();
  drop_round_off(section);
  return section;
}

bool is_resolved(const Section& section) {
  return section.torsion_constant > 1e-8 * section.polar_moment && section.shear_area_y > 0.0 &&
         section.shear_area_z > 0.0 && std::isfinite(section.torsion_constant) && section.area > 0.0;
}

void drop_round_off(Section& section) {
  const auto drop = [](double& value, double scale) {
    if (std::abs(value) < 1e-9 * scale) value = 0.0;
  };
  const double radius = std::sqrt(section.polar_moment / section.area);
  drop(section.second_moment_yz, std::sqrt(section.second_moment_y * section.second_moment_z));
  drop(section.shear_coupling, 1.0 / section.area);
  drop(section.shear_center_y, radius);
  drop(section.shear_center_z, radius);
}

}  // namespace tisserand::formats

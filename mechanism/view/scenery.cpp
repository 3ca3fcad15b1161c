// SPDX-License-Identifier: GPL-3.0-or-later
// Tyres as rings, and roads as strips.
#include "mechanism/view/scenery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanism/tyres/road.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::PageRows;
using formats::SimulatedLink;
using formats::Surface;

/// Fractions of the radius: half width of a ring, its inner radius, margin of the road, spacing of the road.
constexpr double half_width = 0.3, rim = 0.6, margin = 4.0, spacing = 0.15;
constexpr int most_along = 4000, most_tracks = 40;
constexpr int spokes = 40;
constexpr double larger = 1.004;

Track wheel_of(const ViewedRun& run, const SimulatedLink& tyre) {
  const formats::SimulatedMarker& wheel = tyre.ends[0];
  if (wheel.node < 0 || !run.nodes[wheel.node].has_position() || !run.nodes[wheel.node].has_rotation()) return {};
  return carried(run.nodes[wheel.node], wheel.position, wheel.orientation);
}

/// Ring about y: outer face, inner face and both sides. It is slightly larger than the circle, so that a wheel drawn
/// with the same radius is inside.
Surface ring(double radius) {
  Surface surface;
  const double outer = larger * radius / std::cos(std::numbers::pi / spokes);
  const double r[] = {outer, outer, rim * radius, rim * radius},
               y[] = {-half_width * radius, half_width * radius, half_width * radius, -half_width * radius};
  for (int i = 0; i < spokes; ++i)
    for (int k = 0; k < 4; ++k) {
      const double angle = 2.0 * std::numbers::pi * i / spokes;
      surface.vertices.emplace_back(r[k] * std::cos(angle), y[k], r[k] * std::sin(angle));
    }
  for (int i = 0; i < spokes; ++i)
    for (int k = 0; k < 4; ++k) {
      const int a = 4 * i + k, b = 4 * i + (k + 1) % 4, c = 4 * ((i + 1) % spokes) + k,
                d = 4 * ((i + 1) % spokes) + (k + 1) % 4;
      surface.triangles.push_back({a, b, d});
      surface.triangles.push_back({a, d, c});
    }
  return surface;
}

/// Even stations from first to last, at most `apart` from each other and at most `most` intervals.
std::vector<double> stations(double first, double last, double apart, int most) {
  const int count = std::clamp(static_cast<int>(std::ceil((last - first) / apart)), 1, most);
  std::vector<double> places;
  for (int i = 0; i <= count; ++i) places.push_back(first + (last - first) * i / count);
  return places;
}

/// Stations along and across the drawn part of a road.
struct StripStations {
  std::vector<double> along, across;
};

/// Stations of the part in a box in axes of the road; for a road along a line of all of it.
StripStations stations_of(const Road& road, const Eigen::AlignedBox2d& box, double radius) {
  const double apart = spacing * radius;
  if (!road.surface)
    return {stations(std::max(box.min().x(), road.begin), std::min(box.max().x(), road.end), apart, most_along),
            road.transition > 0.0 ? stations(box.min().y(), box.max().y(), apart, most_tracks)
                                  : std::vector<double>{box.min().y(), box.max().y()}};
  const HeightGrid& grid = road.surface->grid;
  Eigen::AlignedBox2d there(Eigen::Vector2d(grid.s_begin(), grid.t_begin()),
                            Eigen::Vector2d(grid.s_end(), grid.t_end()));
  if (!road.surface->line) there = there.intersection(box);
  if (there.isEmpty()) return {};
  return {stations(there.min().x(), there.max().x(), apart, most_along),
          stations(there.min().y(), there.max().y(), apart, most_tracks)};
}

/// Point of the strip, and whether the road exists there.
std::pair<Vector3d, bool> strip_point(const Road& road, double s, double t) {
  Eigen::Vector2d at(s, t);
  if (road.surface && road.surface->line) at = road.surface->line->point(s, t);
  const bool hole = road.surface && road.surface->grid.is_hole(s, t);
  return {{at.x(), at.y(), road.surface ? road.surface->grid.at(s, t).value : road.at(s, t).value}, !hole};
}

/// Surface of the drawn part of the road, without its holes.
Surface strip(const Road& road, const Eigen::AlignedBox2d& box, double radius) {
  const StripStations at = stations_of(road, box, radius);
  Surface surface;
  std::vector<bool> there;
  const int width = count_of(at.across);
  for (std::size_t i = 0; i < at.along.size(); ++i)
    for (int k = 0; k < width; ++k) {
      const auto [point, is_there] = strip_point(road, at.along[i], at.across[k]);
      surface.vertices.push_back(point);
      there.push_back(is_there);
      if (i == 0 || k == 0) continue;
      const int d = surface.size() - 1, c = d - 1, b = d - width, a = b - 1;
      if (!(there[a] && there[b] && there[c] && there[d])) continue;
      surface.triangles.push_back({a, b, d});
      surface.triangles.push_back({a, d, c});
    }
  return surface;
}

Track at_rest(const Vector3d& position, const Matrix3d& rotation) {
  Track track{PageRows(1, 3), PageRows(1, 4)};
  const Quaterniond q(rotation);
  track.position.row(0) = position.transpose();
  track.rotation.row(0) << q.w(), q.x(), q.y(), q.z();
  return track;
}

}  // namespace

TyreContacts tyre_contacts(const ViewedRun& run) {
  if (run.layout().tyres.empty()) return {};
  return {run.reader->read_dataset("tyres/contact", run.rows), run.reader->read_dataset("tyres/normal", run.rows)};
}

Track contact_of(const ViewedRun& run, const TyreContacts& contacts, const SimulatedLink& tyre) {
  const auto& names = run.layout().tyres;
  const auto found = std::ranges::find(names, tyre.name);
  Track track = wheel_of(run, tyre);
  const Eigen::MatrixXd &contact = contacts.centre, &normal = contacts.normal;
  if (found == names.end() || !track.has_position() || contact.cols() == 0 || normal.cols() == 0) return {};
  const Index first = 3 * (found - names.begin());
  for (Index t = 0; t < track.position.rows(); ++t) {
    const Vector3d n = normal.row(t).segment<3>(first).transpose(), axle = track.turn(t) * Vector3d::UnitY();
    Vector3d x = axle.cross(n);
    if (!(x.norm() > 0.0) || !contact.row(t).segment<3>(first).allFinite()) continue;
    x.normalize();
    Matrix3d axes;
    axes << x, n.cross(x), n;
    const Quaterniond q(axes);
    track.position.row(t) = contact.row(t).segment<3>(first);
    track.rotation.row(t) << q.w(), q.x(), q.y(), q.z();
  }
  return track;
}

std::vector<Scenery> scenery_of(const ViewedRun& run) {
  std::vector<Scenery> scenery;
  std::vector<Eigen::AlignedBox2d> passed(run.drawn.roads.size());
  std::vector<double> radius(run.drawn.roads.size(), 0.0);
  for (const SimulatedLink& link : run.layout().simulated.links) {
    const auto spec = std::ranges::find(run.drawn.tyres, link.name, &formats::TyreSpec::name);
    const Track wheel = wheel_of(run, link);
    if (link.kind != "tyre" || spec == run.drawn.tyres.end() || !wheel.has_position()) continue;
    if (!(std::isfinite(spec->radius) && spec->radius > 0.0)) continue;
    scenery.push_back({link.name, "tyre", "#3a3f47", wheel, ring(spec->radius)});
    const auto road = std::ranges::find(run.drawn.roads, spec->road, &formats::RoadSpec::name);
    if (road == run.drawn.roads.end()) continue;
    const auto i = static_cast<std::size_t>(road - run.drawn.roads.begin());
    const Quaterniond back = road->pose.orientation.normalized().conjugate();
    radius[i] = std::max(radius[i], spec->radius);
    for (Index t = 0; t < wheel.position.rows(); ++t)
      passed[i].extend(Eigen::Vector2d((back * (wheel.position.row(t).transpose() - road->pose.position)).head<2>()));
  }
  for (std::size_t i = 0; i < passed.size(); ++i) {
    if (passed[i].isEmpty()) continue;
    const Eigen::Vector2d beyond = Eigen::Vector2d::Constant(margin * radius[i]);
    const Road road(run.drawn.roads[i], Vector3d::Zero());
    Surface drawn = strip(road, {passed[i].min() - beyond, passed[i].max() + beyond}, radius[i]);
    if (drawn.triangles.empty()) continue;
    scenery.push_back({road.name, "road", "#8b9099", at_rest(road.p, road.R), std::move(drawn)});
  }
  return scenery;
}

}  // namespace tisserand::mechanism

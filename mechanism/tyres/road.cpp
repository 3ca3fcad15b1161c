// SPDX-License-Identifier: GPL-3.0-or-later
// Heights of pieces, tracks and roads.
#include "mechanism/tyres/road.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tisserand::mechanism {
namespace {

std::vector<RoadPiece> pieces_of(const std::vector<formats::RoadPieceSpec>& specs) {
  std::vector<RoadPiece> pieces;
  for (const formats::RoadPieceSpec& spec : specs) {
    RoadPiece piece{spec.shape, spec.start, spec.length, spec.height, spec.ramp, 0.0};
    if (spec.shape == formats::RoadPieceShape::curve) {
      piece.start = spec.curve.x.front();
      piece.length = spec.curve.x.back() - piece.start;
      piece.curve = Curve(formats::LawSpec(spec.curve));
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

RoadHeight track_height(const std::vector<RoadPiece>& track, double x) {
  RoadHeight sum;
  for (const RoadPiece& piece : track) {
    const RoadHeight h = piece.at(x);
    sum.value += h.value;
    sum.by_x += h.by_x;
  }
  return sum;
}

std::shared_ptr<const RoadSurface> surface_of(const formats::RoadSpec& spec) {
  if (!spec.heights) return nullptr;
  RoadSurface surface{HeightGrid(*spec.heights), std::nullopt};
  if (spec.heights->line.cols() > 0)
    surface.line.emplace(spec.heights->line, spec.heights->along.front(), spec.heights->along.back());
  return std::make_shared<const RoadSurface>(std::move(surface));
}

RoadHeight surface_height(const RoadSurface& surface, double x, double y) {
  if (!surface.line) {
    const GridHeight h = surface.grid.at(x, y);
    return {h.value, h.by_s, h.by_t};
  }
  const LinePlace place = surface.line->find({x, y});
  const GridHeight h = surface.grid.at(place.u, place.v);
  return {h.value, h.by_s * place.u_by.x() + h.by_t * place.v_by.x(),
          h.by_s * place.u_by.y() + h.by_t * place.v_by.y()};
}

std::optional<RoadLack> surface_lack(const RoadSurface& surface, double x, double y) {
  RoadLack lack;
  lack.place = {x, y};
  if (surface.line) {
    const LinePlace at = surface.line->find({x, y});
    lack.place = {at.u, at.v};
  }
  const HeightGrid& grid = surface.grid;
  const double s = lack.place.x(), t = lack.place.y();
  const bool along = !(s >= grid.s_begin() && s <= grid.s_end());
  if (along || !(t >= grid.t_begin() && t <= grid.t_end())) {
    lack.axis = surface.line ? (along ? 'u' : 'v') : (along ? 'x' : 'y');
    lack.at = along ? s : t;
    lack.begin = along ? grid.s_begin() : grid.t_begin();
    lack.end = along ? grid.s_end() : grid.t_end();
    return lack;
  }
  lack.hole = grid.is_hole(s, t);
  return lack.hole ? std::optional(lack) : std::nullopt;
}

}  // namespace

RoadHeight RoadPiece::at(double x) const {
  const double s = x - start;
  if (shape == formats::RoadPieceShape::curve) {
    const Curve::Value z = curve(std::clamp(x, start, start + length));
    return {z.value, s < 0.0 || s > length ? 0.0 : z.slope, 0.0};
  }
  if (s <= 0.0 || s >= length) return {};
  if (shape == formats::RoadPieceShape::cosine) {
    const double k = 2.0 * std::numbers::pi / length;
    return {0.5 * height * (1.0 - std::cos(k * s)), 0.5 * height * k * std::sin(k * s), 0.0};
  }
  const double slope = height / ramp;
  if (s < ramp) return {slope * s, slope, 0.0};
  if (s > length - ramp) return {slope * (length - s), -slope, 0.0};
  return {height, 0.0, 0.0};
}

Road::Road(const formats::RoadSpec& spec, const Eigen::Vector3d& origin)
    : name(spec.name),
      p(spec.pose.position - origin),
      R(spec.pose.orientation.normalized().toRotationMatrix()),
      left(pieces_of(spec.left)),
      right(pieces_of(spec.transition ? spec.right : std::vector<formats::RoadPieceSpec>{})),
      transition(spec.transition.value_or(0.0)),
      begin(-std::numeric_limits<double>::infinity()),
      end(-begin),
      surface(surface_of(spec)),
      friction(spec.friction),
      friction_right(spec.friction_right.value_or(spec.friction)) {
  if (surface) {
    begin = surface->grid.s_begin();
    end = surface->grid.s_end();
  }
  for (const auto* track : {&left, &right})
    for (const RoadPiece& piece : *track) {
      if (piece.shape != formats::RoadPieceShape::curve) continue;
      begin = std::max(begin, piece.start);
      end = std::min(end, piece.start + piece.length);
    }
}

std::optional<RoadLack> Road::lack(double x, double y) const {
  if (surface) return surface_lack(*surface, x, y);
  if (x >= begin && x <= end) return std::nullopt;
  return RoadLack{false, 'x', x, begin, end, {x, y}};
}

double Road::friction_at(double x, double y, double strip) const {
  if (friction == friction_right) return friction;
  const double beside = surface && surface->line ? surface->line->find({x, y}).v : y;
  const double t = std::clamp(0.5 + beside / strip, 0.0, 1.0);
  return friction_right + t * t * (3.0 - 2.0 * t) * (friction - friction_right);
}

RoadHeight Road::at(double x, double y) const {
  if (surface) return surface_height(*surface, x, y);
  if (transition == 0.0) return track_height(left, x);
  const double t = 0.5 + y / transition;
  if (t <= 0.0) return track_height(right, x);
  if (t >= 1.0) return track_height(left, x);
  const RoadHeight l = track_height(left, x), r = track_height(right, x);
  const double share = t * t * (3.0 - 2.0 * t), slope = 6.0 * t * (1.0 - t) / transition;
  return {r.value + share * (l.value - r.value), r.by_x + share * (l.by_x - r.by_x), slope * (l.value - r.value)};
}

}  // namespace tisserand::mechanism

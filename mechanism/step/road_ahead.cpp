// SPDX-License-Identifier: GPL-3.0-or-later
// Marks of roads, and the time of wheels to them.
#include "mechanism/step/road_ahead.hpp"

#include <algorithm>
#include <limits>

namespace tisserand::mechanism {
namespace {

/// Adds the points where the height of a piece changes its law, and intermediate points that a step must not pass over.
void add_marks(const formats::RoadPieceSpec& piece, std::vector<double>& marks) {
  const double end = piece.start + piece.length;
  if (piece.shape == formats::RoadPieceShape::trapezoid) {
    for (const double part : {0.0, 0.5, 1.0}) {
      marks.push_back(piece.start + part * piece.ramp);
      marks.push_back(end - part * piece.ramp);
    }
    return;
  }
  if (piece.shape == formats::RoadPieceShape::curve) {
    marks.insert(marks.end(), piece.curve.x.begin(), piece.curve.x.end());
    return;
  }
  for (int quarter = 0; quarter <= 4; ++quarter) marks.push_back(piece.start + 0.25 * quarter * piece.length);
}

/// Time to the next of the ascending marks from x at the rate v. Marks nearer than `least` count as passed.
double time_along(const std::vector<double>& marks, double x, double v, double least) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (v > 0.0) {
    const auto next = std::ranges::upper_bound(marks, x + v * least);
    return next == marks.end() ? never : (*next - x) / v;
  }
  if (v < 0.0) {
    const auto next = std::ranges::lower_bound(marks, x + v * least);
    return next == marks.begin() ? never : (*std::prev(next) - x) / v;
  }
  return never;
}

}  // namespace

RoadAhead::RoadAhead(const formats::Scene& scene, const Model& model) {
  for (const Road& road : model.roads) {
    std::vector<double>& marks = marks_.emplace_back();
    const auto spec = std::ranges::find(scene.roads, road.name, &formats::RoadSpec::name);
    for (const auto* track : {&spec->left, &spec->right})
      for (const formats::RoadPieceSpec& piece : *track) add_marks(piece, marks);
    std::ranges::sort(marks);
    any_ = any_ || !marks.empty();
  }
}

double RoadAhead::time_to_next(const Model& model, const Evaluation& evaluation, double step) const {
  const double least = 0.01 * step;
  double time = std::numeric_limits<double>::infinity();
  for (const Tyre& tyre : model.tyres) {
    const Road& road = model.roads[tyre.road];
    if (marks_[tyre.road].empty()) continue;
    const NodeMotion& wheel = motion_of(evaluation, tyre.wheel.node);
    const Eigen::Vector3d along = road.R.col(0), centre = wheel.x + wheel.R * tyre.wheel.p;
    time = std::min(time, time_along(marks_[tyre.road], along.dot(centre - road.p), along.dot(wheel.xd), least));
  }
  return time;
}

}  // namespace tisserand::mechanism

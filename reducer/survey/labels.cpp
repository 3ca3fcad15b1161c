// SPDX-License-Identifier: GPL-3.0-or-later
// Placement of labels by a search around each place.
#include "reducer/survey/labels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tisserand::reducer {
namespace {

using Eigen::Vector2d;

constexpr double letter_width = 9.0, letter_height = 16.0, gap = 3.0;  // pixels
constexpr int directions_tried = 32;

bool overlap(const Vector2d& a, const Vector2d& size_a, const Vector2d& b, const Vector2d& size_b) {
  const Vector2d apart = (a - b).cwiseAbs(), reach = 0.5 * (size_a + size_b) + Vector2d::Constant(gap);
  return apart.x() < reach.x() && apart.y() < reach.y();
}

}  // namespace

Vector2d text_size(const std::string& text) { return {letter_width * static_cast<double>(text.size()), letter_height}; }

bool fits_inside(const SeenPlace& seen, const std::string& text) {
  return 0.5 * text_size(text).norm() <= seen.radius + 3.0;
}

bool LabelPlacer::is_free(const Vector2d& at, const Vector2d& size) const {
  if (at.x() < 0.5 * size.x() || at.y() < 0.5 * size.y() || at.x() > projection_.width() - 0.5 * size.x() ||
      at.y() > projection_.height() - 0.5 * size.y())
    return false;
  return std::ranges::none_of(labels_, [&](const PictureLabel& label) {
    return overlap(at, size, label.at, text_size(label.text)) || overlap(at, size, label.point, Vector2d::Zero());
  });
}

void LabelPlacer::write_inside(const std::string& text, const SeenPlace& seen) {
  labels_.push_back({text, seen.place, seen.place, false});
}

bool LabelPlacer::write_beside(const std::string& text, const SeenPlace& seen) {
  constexpr double off_background = 60.0;  // pixels added to the distance of a place on another surface
  const Vector2d size = text_size(text);
  double least = std::numeric_limits<double>::infinity();
  Vector2d best = Vector2d::Zero();
  for (const double radius : {24.0, 34.0, 48.0, 64.0, 84.0, 110.0, 140.0, 180.0})
    for (int k = 0; k < directions_tried; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / directions_tried;
      const Vector2d at = seen.place + Vector2d((radius + 0.5 * size.x()) * std::cos(angle), radius * std::sin(angle));
      if (!is_free(at, size)) continue;
      const double cost = radius + (projection_.covers(at) ? off_background : 0.0);
      if (cost < least) least = cost, best = at;
    }
  if (!std::isfinite(least)) return false;
  labels_.push_back({text, best, seen.place, true});
  return true;
}

}  // namespace tisserand::reducer

// Distances within a picture, and a search around each place.
#include "reducer/survey/labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tisserand::reducer {
namespace {

using Eigen::Vector2d;

constexpr double letter_width = 9.0, letter_height = 16.0, gap = 3.0;  // pixels
constexpr int directions_tried = 32;

/// Pixels to the nearest pixel of another surface: chamfer distances 3-4 (Borgefors, Computer Vision, Graphics, and
/// Image Processing 34, 1986), in thirds.
std::vector<int> distances(const Raster& raster) {
  const int w = raster.width, h = raster.height;
  const auto index = [w](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
  };
  std::vector<int> distance(raster.surface.size(), std::numeric_limits<int>::max() / 2);
  const auto relax = [&](int x, int y, int dx, int dy) {
    const std::size_t at = index(x, y);
    const bool is_inside = x + dx >= 0 && y + dy >= 0 && x + dx < w && y + dy < h;
    const int step = dx != 0 && dy != 0 ? 4 : 3;
    const int other =
        is_inside && raster.surface[index(x + dx, y + dy)] == raster.surface[at] ? distance[index(x + dx, y + dy)] : 0;
    distance[at] = std::min(distance[at], other + step);
  };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) relax(x, y, dx, dy);
  for (int y = h - 1; y >= 0; --y)
    for (int x = w - 1; x >= 0; --x)
      for (const auto& [dx, dy] : {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}}) relax(x, y, dx, dy);
  return distance;
}

bool overlap(const Vector2d& a, const Vector2d& size_a, const Vector2d& b, const Vector2d& size_b) {
  const Vector2d apart = (a - b).cwiseAbs(), reach = 0.5 * (size_a + size_b) + Vector2d::Constant(gap);
  return apart.x() < reach.x() && apart.y() < reach.y();
}

}  // namespace

std::vector<SeenPlace> seen_places(const Raster& raster, std::size_t surfaces) {
  const std::vector<int> distance = distances(raster);
  std::vector<SeenPlace> places(surfaces);
  for (std::size_t at = 0; at < distance.size(); ++at) {
    if (raster.surface[at] < 0) continue;
    SeenPlace& seen = places[raster.surface[at]];
    if (distance[at] / 3.0 <= seen.radius) continue;
    const auto width = static_cast<std::size_t>(raster.width);
    seen = {Vector2d(static_cast<double>(at % width) + 0.5, static_cast<double>(at / width) + 0.5), distance[at] / 3.0};
  }
  return places;
}

Vector2d text_size(const std::string& text) { return {letter_width * static_cast<double>(text.size()), letter_height}; }

bool fits_inside(const SeenPlace& seen, const std::string& text) {
  return 0.5 * text_size(text).norm() <= seen.radius + 3.0;
}

bool LabelPlacer::is_free(const Vector2d& at, const Vector2d& size) const {
  if (at.x() < 0.5 * size.x() || at.y() < 0.5 * size.y() || at.x() > raster_.width - 0.5 * size.x() ||
      at.y() > raster_.height - 0.5 * size.y())
    return false;
  return std::ranges::none_of(labels_, [&](const PictureLabel& label) {
    return overlap(at, size, label.at, text_size(label.text)) || overlap(at, size, label.point, Vector2d::Zero());
  });
}

bool LabelPlacer::is_background(const Vector2d& at) const {
  const auto pixel =
      static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(raster_.width) + static_cast<std::size_t>(at.x());
  return raster_.surface[pixel] < 0;
}

void LabelPlacer::write_inside(const std::string& text, const SeenPlace& seen) {
  labels_.push_back({text, seen.place, seen.place, false});
}

bool LabelPlacer::write_beside(const std::string& text, const SeenPlace& seen) {
  constexpr double off_background = 60.0;  // pixels that a place on another surface counts farther
  const Vector2d size = text_size(text);
  double least = std::numeric_limits<double>::infinity();
  Vector2d best = Vector2d::Zero();
  for (const double radius : {24.0, 34.0, 48.0, 64.0, 84.0, 110.0, 140.0, 180.0})
    for (int k = 0; k < directions_tried; ++k) {
      const double angle = 2.0 * EIGEN_PI * k / directions_tried;
      const Vector2d at = seen.place + Vector2d((radius + 0.5 * size.x()) * std::cos(angle), radius * std::sin(angle));
      if (!is_free(at, size)) continue;
      const double cost = radius + (is_background(at) ? 0.0 : off_background);
      if (cost < least) least = cost, best = at;
    }
  if (!std::isfinite(least)) return false;
  labels_.push_back({text, best, seen.place, true});
  return true;
}

}  // namespace tisserand::reducer

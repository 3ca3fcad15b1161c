// Triangles into a buffer of depths.
#include "reducer/survey/raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <Eigen/Geometry>

namespace tisserand::reducer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;

constexpr int samples_across = 2;        // per pixel
constexpr double crease = 0.77;          // cosine of 40 degrees: beyond, facets keep their own normals
constexpr double line_brightness = 0.2;  // of edges
constexpr double depth_of_edge = 0.02;   // of the height of the picture: jumps of depth within a surface

/// Samples of the whole picture.
class Buffer {
 public:
  Buffer(int width, int height)
      : width_(width),
        height_(height),
        depth_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
               -std::numeric_limits<float>::infinity()),
        surface_(depth_.size(), -1),
        light_(depth_.size(), 0.0F) {}

  /// Corners in samples (right, down) and depth towards the eye; one normal per corner in axes of the view.
  void add(const std::array<Vector3d, 3>& x, const std::array<Vector3d, 3>& normal, int surface) {
    const Vector2d a = x[0].head<2>(), b = x[1].head<2>(), c = x[2].head<2>();
    const double twice_area = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
    if (std::abs(twice_area) < 1e-9) return;
    const auto [left, right] = std::minmax({a.x(), b.x(), c.x()});
    const auto [top, bottom] = std::minmax({a.y(), b.y(), c.y()});
    const int first_column = std::max(0, static_cast<int>(std::ceil(left - 0.5)));
    const int last_column = std::min(width_ - 1, static_cast<int>(std::floor(right - 0.5)));
    const int last_row = std::min(height_ - 1, static_cast<int>(std::floor(bottom - 0.5)));
    for (int row = std::max(0, static_cast<int>(std::ceil(top - 0.5))); row <= last_row; ++row)
      for (int column = first_column; column <= last_column; ++column) {
        const Vector2d p(column + 0.5, row + 0.5);
        const double u = ((b - p).x() * (c - p).y() - (b - p).y() * (c - p).x()) / twice_area;
        const double v = ((c - p).x() * (a - p).y() - (c - p).y() * (a - p).x()) / twice_area;
        const double w = 1.0 - u - v;
        if (u < -1e-9 || v < -1e-9 || w < -1e-9) continue;
        const auto depth = static_cast<float>(u * x[0].z() + v * x[1].z() + w * x[2].z());
        const std::size_t at = index(column, row);
        if (depth <= depth_[at]) continue;
        depth_[at] = depth;
        surface_[at] = surface;
        light_[at] = light_of(u * normal[0] + v * normal[1] + w * normal[2]);
      }
  }

  Raster picture(const std::vector<ColouredSurface>& surfaces) const {
    Raster raster;
    raster.width = width_ / samples_across;
    raster.height = height_ / samples_across;
    for (int row = 0; row < raster.height; ++row)
      for (int column = 0; column < raster.width; ++column) {
        raster.surface.push_back(surface_[index(column * samples_across, row * samples_across)]);
        Vector3d sum = Vector3d::Zero();
        for (int i = 0; i < samples_across; ++i)
          for (int j = 0; j < samples_across; ++j)
            sum += colour_at(surfaces, column * samples_across + i, row * samples_across + j);
        for (const double part : sum)
          raster.colour.push_back(
              static_cast<std::uint8_t>(std::lround(255.0 * std::min(1.0, part / (samples_across * samples_across)))));
      }
    return raster;
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
  }

  /// A lamp above the left shoulder, and some light from everywhere; both sides of a surface are lit alike.
  static float light_of(const Vector3d& normal) {
    static const Vector3d lamp = Vector3d(-0.35, 0.55, 0.75).normalized();
    const Vector3d n = (normal.z() < 0.0 ? -1.0 : 1.0) * normal.normalized();
    return static_cast<float>(0.74 + 0.30 * std::max(0.0, n.dot(lamp)));
  }

  bool is_edge(int column, int row) const {
    const std::size_t at = index(column, row);
    for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
      const int x = column + dx, y = row + dy;
      if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
      const std::size_t other = index(x, y);
      if (surface_[other] != surface_[at]) return true;
      if (surface_[at] >= 0 && std::abs(depth_[other] - depth_[at]) > depth_of_edge * height_) return true;
    }
    return false;
  }

  Vector3d colour_at(const std::vector<ColouredSurface>& surfaces, int column, int row) const {
    const std::size_t at = index(column, row);
    if (is_edge(column, row)) return Vector3d::Constant(line_brightness);
    if (surface_[at] < 0) return Vector3d::Ones();
    const auto& [red, green, blue] = surfaces[surface_[at]].colour;
    return static_cast<double>(light_[at]) * Vector3d(red, green, blue);
  }

  int width_, height_;
  std::vector<float> depth_;
  std::vector<int> surface_;
  std::vector<float> light_;
};

Vector3d facet_normal(const Cell& cell, const Positions& x) {
  const auto at = [&](int k) { return x[cell.nodes[k]]; };
  return form_of(cell.shape).corners == 3 ? (at(1) - at(0)).cross(at(2) - at(0)) : (at(2) - at(0)).cross(at(3) - at(1));
}

/// Mean of the facets around each corner, weighted with their areas.
std::unordered_map<int, Vector3d> node_normals(const ColouredSurface& surface, const Positions& x) {
  std::unordered_map<int, Vector3d> sums;
  for (const Cell& cell : surface.cells)
    for (int k = 0; k < form_of(cell.shape).corners; ++k)
      sums.try_emplace(cell.nodes[k], Vector3d::Zero()).first->second += facet_normal(cell, x);
  return sums;
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

Raster rasterise(const std::vector<ColouredSurface>& surfaces, const Positions& position, const PictureView& view,
                 int width, int height) {
  Buffer buffer(width * samples_across, height * samples_across);
  const double scale = samples_across / view.pixel;
  const auto projected = [&](int node) {
    const Vector3d x = view.R_VW * position[node];
    return Vector3d(scale * (x.x() - view.low.x()), samples_across * height - scale * (x.y() - view.low.y()),
                    scale * x.z());
  };
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const std::unordered_map<int, Vector3d> normals = node_normals(surfaces[s], position);
    for (const Cell& cell : surfaces[s].cells) {
      const Vector3d facet = facet_normal(cell, position).normalized();
      const auto normal = [&](int node) {
        const Vector3d mean = normals.at(node).normalized();
        return Vector3d(view.R_VW * (std::abs(mean.dot(facet)) > crease ? mean : facet));
      };
      for (int k = 2; k < form_of(cell.shape).corners; ++k) {
        const std::array nodes{cell.nodes[0], cell.nodes[k - 1], cell.nodes[k]};
        buffer.add({projected(nodes[0]), projected(nodes[1]), projected(nodes[2])},
                   {normal(nodes[0]), normal(nodes[1]), normal(nodes[2])}, static_cast<int>(s));
      }
    }
  }
  return buffer.picture(surfaces);
}

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// A view of coloured surfaces as polygons from back to front, and the visible surface at each place.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

struct ColouredSurface {
  std::vector<Cell> cells;                ///< of dimension 2
  std::array<double, 3> colour{1, 1, 1};  ///< red, green, blue, 0 to 1
};

/// Parallel projection; rows: right, up, and towards the eye.
struct PictureView {
  Eigen::Matrix3d R_VW = Eigen::Matrix3d::Identity();
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< right and up at the lower left corner of the picture
  double pixel = 1.0;                             ///< length of one pixel
};

/// View from `eye` (any length) with z upwards. All positions are inside with a margin of 6 %.
PictureView view_from(const Eigen::Vector3d& eye, const std::vector<Eigen::Vector3d>& position, int width, int height);

struct PaintedPolygon {
  std::vector<Eigen::Vector2d> corners;  ///< pixels to the right and down
  std::array<double, 3> colour{0, 0, 0};
};

/// Visible place of a surface.
struct SeenPlace {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< pixels to the right and down
  double radius = 0.0;                              ///< pixels to the nearest place off the surface; 0: not visible
};

class Projection {
 public:
  Projection(const std::vector<ColouredSurface>& surfaces, const std::vector<Eigen::Vector3d>& position,
             const PictureView& view, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Polygons from back to front by their middles. They are small, so this is the order in which they hide one another.
  /// Facets are lit by mean normals; edges of surfaces are dark.
  std::vector<PaintedPolygon> polygons() const;
  /// Place on each surface for its label: the middle of a visible cell, as far as possible from the edges and from
  /// hidden places of the surface.
  std::vector<SeenPlace> seen_places() const;
  /// Whether a surface is visible at this place.
  bool covers(const Eigen::Vector2d& at) const;

 private:
  struct Triangle {
    std::array<Eigen::Vector3d, 3> x;  ///< pixels to the right, down, and towards the eye
    double light = 1.0;
    int surface = 0;
  };
  struct Segment {
    Eigen::Vector3d a, b;
    int surface = 0;
  };

  void add(const ColouredSurface& surface, int number, const std::vector<Eigen::Vector3d>& position,
           const PictureView& view);
  /// Triangles that may cover a point.
  const std::vector<int>& near(const Eigen::Vector2d& at) const;
  bool is_hidden(const Eigen::Vector3d& place) const;

  int width_, height_, columns_;
  std::vector<std::array<double, 3>> colour_;
  std::vector<Triangle> triangles_;
  std::vector<Segment> rims_;
  std::vector<std::vector<Eigen::Vector3d>> middles_;  ///< middles of the cells of each surface
  std::vector<std::vector<int>> buckets_;              ///< squares of the picture
};

}  // namespace tisserand::reducer

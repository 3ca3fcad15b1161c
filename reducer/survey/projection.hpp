// SPDX-License-Identifier: GPL-3.0-or-later
// A view of coloured surfaces as polygons from back to front, and the visible surface at each place.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// Cells of a surface that a picture draws in one colour.
struct ColouredSurface {
  std::vector<Cell> cells;                ///< cells of dimension 2
  std::array<double, 3> colour{1, 1, 1};  ///< red, green, blue, 0 to 1
};

/// View of a parallel projection. The rows of R_VW are the directions to the right, up, and towards the eye.
struct PictureView {
  Eigen::Matrix3d R_VW = Eigen::Matrix3d::Identity();
  /// Coordinates to the right and up of the lower left corner of the picture.
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  double pixel = 1.0;  ///< length of one pixel
};

/// View from the direction `eye` (any length) with z upwards. All positions are inside the picture with a margin of 6
/// %.
PictureView view_from(const Eigen::Vector3d& eye, const std::vector<Eigen::Vector3d>& position, int width, int height);

/// Polygon of a picture in pixels, with its colour.
struct PaintedPolygon {
  std::vector<Eigen::Vector2d> corners;  ///< pixels to the right and down
  std::array<double, 3> colour{0, 0, 0};
};

/// Place at which a surface is visible, for its label.
struct SeenPlace {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< pixels to the right and down
  /// Distance in pixels to the nearest place off the surface; 0: not visible.
  double radius = 0.0;
};

/// Parallel projection of coloured surfaces to a picture.
class PictureProjection {
 public:
  PictureProjection(const std::vector<ColouredSurface>& surfaces, const std::vector<Eigen::Vector3d>& position,
                    const PictureView& view, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Polygons of the surfaces in the order of painting, from back to front by their middles. The polygons are small,
  /// so this is the order in which they hide one another. Facets are lit by mean normals, and edges of surfaces are
  /// dark.
  std::vector<PaintedPolygon> polygons() const;
  /// Place on each surface for its label. It is the middle of a visible cell, as far as possible from the edges and
  /// from hidden places of the surface.
  std::vector<SeenPlace> seen_places() const;
  /// Whether any surface is visible at the place `at` (pixels to the right and down).
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
  /// Numbers of the triangles that may cover a point.
  const std::vector<int>& near(const Eigen::Vector2d& at) const;
  bool is_hidden(const Eigen::Vector3d& place) const;

  int width_, height_, columns_;
  std::vector<std::array<double, 3>> colour_;
  std::vector<Triangle> triangles_;
  std::vector<Segment> rims_;
  std::vector<std::vector<Eigen::Vector3d>> middles_;  ///< middles of the cells of each surface
  std::vector<std::vector<int>> buckets_;              ///< for each square of the picture: triangles that may cover it
};

}  // namespace tisserand::reducer

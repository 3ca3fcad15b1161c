// A view of coloured surfaces as pixels: which surface is seen where, and how it is lit.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

struct ColouredSurface {
  std::vector<Cell> cells;                ///< of dimension 2
  std::array<double, 3> colour{1, 1, 1};  ///< red, green, blue, 0 to 1
};

/// A parallel projection: rows right, up, and towards the eye.
struct PictureView {
  Eigen::Matrix3d R_VW = Eigen::Matrix3d::Identity();
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< right and up at the lower left corner of the picture
  double pixel = 1.0;                             ///< length of a pixel
};

struct Raster {
  int width = 0, height = 0;
  std::vector<int> surface;          ///< per pixel, rows from the top: the one that is seen, or -1
  std::vector<std::uint8_t> colour;  ///< red, green, blue per pixel on white
};

/// Looks from `eye` (any length) with z upwards, all positions inside with a margin of 6 %.
PictureView view_from(const Eigen::Vector3d& eye, const std::vector<Eigen::Vector3d>& position, int width, int height);

/// Draws with a depth per sample, four samples a pixel; curved surfaces are lit by mean normals, edges where surfaces
/// meet are dark.
Raster rasterise(const std::vector<ColouredSurface>& surfaces, const std::vector<Eigen::Vector3d>& position,
                 const PictureView& view, int width, int height);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Heights on a grid of two coordinates: a surface without kinks through its points.
#pragma once

#include <cstdint>
#include <vector>

#include "common/math/count.hpp"
#include "formats/roads/road_heights.hpp"

namespace tisserand::mechanism {

/// Height z of a surface and its slopes by the two coordinates s and t.
struct GridHeight {
  double value = 0.0, by_s = 0.0, by_t = 0.0;
};

/// Surface z(s, t) through heights on a grid, by bicubic Hermite interpolation of z, ∂z/∂s, ∂z/∂t and ∂²z/∂s∂t at its
/// points. z and its gradient are continuous, and z is exact at the points. Slopes are those of polynomials through
/// five neighbours (fewer if there are not five, one-sided at borders and holes). So polynomials of degree three in
/// each coordinate are exact. Beyond the borders of the grid the surface continues straight. A cell with a missing
/// height at a corner is a hole, in which the values are finite but have no meaning.
class HeightGrid {
 public:
  explicit HeightGrid(const formats::RoadHeights& heights);

  GridHeight at(double s, double t) const;
  bool is_hole(double s, double t) const;

  double s_begin() const { return along_.front(); }
  double s_end() const { return along_.back(); }
  double t_begin() const { return across_.front(); }
  double t_end() const { return across_.back(); }

 private:
  struct Node {
    double z = 0.0, by_s = 0.0, by_t = 0.0, by_st = 0.0;
  };
  int width() const { return count_of(across_); }
  /// Gives each missing point the height of the next point in its row, else of the next row, and no slopes.
  void fill_holes();

  std::vector<double> along_, across_;
  std::vector<Node> nodes_;            ///< rows of across_
  std::vector<std::uint8_t> missing_;  ///< per node; empty: none
};

}  // namespace tisserand::mechanism

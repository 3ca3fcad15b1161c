// SPDX-License-Identifier: GPL-3.0-or-later
// Heights of a road on a grid of two coordinates.
#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tisserand::formats {

using HeightTable = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Road heights z at points (s_i, t_k): s along the road, t to its left, both ascending. Without a
/// reference line, s and t are x and y of the road's axes. With a reference line, s is OpenCRG's coordinate u and t the
/// distance from the line. The points of the line have equal steps of u from s.front() to s.back().
struct RoadHeights {
  std::vector<double> along;   ///< s
  std::vector<double> across;  ///< t
  HeightTable height;          ///< (along x across); NaN: no road there
  Eigen::Matrix2Xd line;       ///< points of the line in the road's x-y plane; two: straight; none: no line
};

/// Largest number of heights that a file may have.
inline constexpr std::size_t most_road_heights = 10'000'000;

/// Fault of road heights, or empty. Axes must have two or more ascending values, at least 1e-9 of their size apart.
/// There must be one height per pair of axis values, and at least one known height. Numbers must be at most 1e12.
std::string fault_of(const RoadHeights& road);

/// Opens a road file of at most 1 GiB. Throws Error with `remedy`.
std::ifstream open_road_file(const std::string& path, const std::string& remedy);

}  // namespace tisserand::formats

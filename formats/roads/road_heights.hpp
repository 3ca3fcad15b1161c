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

/// Heights z at (s_i, t_k): s along the road, t to its left, both ascending. Without a line, s and t are x and y of the
/// road's axes. With a line, s is the u of OpenCRG: its points have equal steps of u from s.front() to s.back(), and t
/// is the distance from the line.
struct RoadHeights {
  std::vector<double> along;   ///< s
  std::vector<double> across;  ///< t
  HeightTable height;          ///< along × across; not-a-number: no road there
  Eigen::Matrix2Xd line;       ///< in the road's x-y plane; two points: straight
};

/// Largest number of heights that a file may have.
inline constexpr std::size_t most_road_heights = 10'000'000;

/// Fault of a grid, or empty. Axes have two or more ascending values, at least 1e-9 of their size apart. There is one
/// height per pair, of which at least one is known. Numbers are at most 1e12.
std::string fault_of(const RoadHeights& road);

/// Opens a file of at most 1 GiB. Throws Error.
std::ifstream open_road_file(const std::string& path, const std::string& remedy);

}  // namespace tisserand::formats

// Heights of a road over two coordinates, as files of grids give them.
#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tisserand::formats {

using HeightTable = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// z at (s_i, t_k): s along the road, t to its left, both ascending. Without a line s and t are x and y of the road's
/// axes. With a line s is the u of OpenCRG: its points stand at equal steps of u from s.front() to s.back(), and t is
/// the distance from it.
struct RoadHeights {
  std::vector<double> along;   ///< s
  std::vector<double> across;  ///< t
  HeightTable height;          ///< along × across; not-a-number: there is no road
  Eigen::Matrix2Xd line;       ///< of the road's x-y plane; two points: straight
};

/// More heights are an error of the file.
inline constexpr std::size_t most_road_heights = 10'000'000;

/// What is wrong with a grid, or nothing: axes of two values or more that ascend, not closer than 1e-9 of their size;
/// one height for each pair, of which one is there at least; numbers up to 1e12.
std::string fault_of(const RoadHeights& road);

/// The open file, of at most 1 GiB. Throws Error.
std::ifstream open_road_file(const std::string& path, const std::string& remedy);

}  // namespace tisserand::formats

// SPDX-License-Identifier: GPL-3.0-or-later
// Checks and file access that the readers of roads share.
#include "formats/roads/road_heights.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "common/error.hpp"
#include "formats/tables/text_cells.hpp"

namespace tisserand::formats {
namespace {

constexpr std::uint64_t most_road_bytes = std::uint64_t{1} << 30;

constexpr double largest_road_number = 1e12, closest = 1e-9;

bool is_large(double value) { return !(std::abs(value) <= largest_road_number); }

std::string fault_of_axis(const std::vector<double>& axis, const char* name) {
  if (axis.size() < 2) return fmt::format("has {} positions {}", axis.size(), name);
  for (const double at : axis)
    if (is_large(at)) return fmt::format("reaches {:g} {}, beyond the limit of {:g}", at, name, largest_road_number);
  const double apart = closest * std::max(std::abs(axis.front()), std::abs(axis.back()));
  for (std::size_t i = 1; i < axis.size(); ++i)
    if (!(axis[i] - axis[i - 1] > apart))
      return fmt::format(
          "has the positions {:.17g} and {:.17g} {}; they must increase by more than {:g} of the largest position",
          axis[i - 1], axis[i], name, closest);
  return {};
}

}  // namespace

std::string fault_of(const RoadHeights& road) {
  for (const auto& [axis, name] :
       {std::pair{&road.along, "along the road"}, std::pair{&road.across, "across the road"}})
    if (std::string fault = fault_of_axis(*axis, name); !fault.empty()) return fault;
  if (road.height.rows() != static_cast<Eigen::Index>(road.along.size()) ||
      road.height.cols() != static_cast<Eigen::Index>(road.across.size()))
    return fmt::format("has {} x {} heights for {} x {} positions", road.height.rows(), road.height.cols(),
                       road.along.size(), road.across.size());
  bool any = false;
  for (const double z : road.height.reshaped()) {
    if (std::isnan(z)) continue;
    if (is_large(z)) return fmt::format("has a height of {:g}, beyond the limit of {:g}", z, largest_road_number);
    any = true;
  }
  for (const double at : road.line.reshaped())
    if (is_large(at))
      return fmt::format("has a reference line that reaches {:g}, beyond the limit of {:g}", at, largest_road_number);
  return any ? "" : "has no heights";
}

std::ifstream open_road_file(const std::string& path, const std::string& remedy) {
  std::ifstream stream = open_table(path, remedy);
  std::error_code ignored;
  const std::uint64_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > most_road_bytes)
    throw Error(fmt::format("has {} bytes; the limit is {}", size, most_road_bytes), path,
                "reduce the number of points");
  return stream;
}

}  // namespace tisserand::formats

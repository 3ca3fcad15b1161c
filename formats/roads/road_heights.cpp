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
  if (axis.size() < 2) return fmt::format("has {} values {}", axis.size(), name);
  for (const double at : axis)
    if (is_large(at)) return fmt::format("reaches {:g} {}, more than {:g}", at, name, largest_road_number);
  const double apart = closest * std::max(std::abs(axis.front()), std::abs(axis.back()));
  for (std::size_t i = 1; i < axis.size(); ++i)
    if (!(axis[i] - axis[i - 1] > apart))
      return fmt::format("has the values {:.17g} and {:.17g} {}, which do not ascend, or hardly", axis[i - 1], axis[i],
                         name);
  return {};
}

}  // namespace

std::string fault_of(const RoadHeights& road) {
  for (const auto& [axis, name] : {std::pair{&road.along, "along it"}, std::pair{&road.across, "across it"}})
    if (std::string fault = fault_of_axis(*axis, name); !fault.empty()) return fault;
  if (road.height.rows() != static_cast<Eigen::Index>(road.along.size()) ||
      road.height.cols() != static_cast<Eigen::Index>(road.across.size()))
    return fmt::format("has {} x {} heights for {} x {} places", road.height.rows(), road.height.cols(),
                       road.along.size(), road.across.size());
  bool any = false;
  for (const double z : road.height.reshaped()) {
    if (std::isnan(z)) continue;
    if (is_large(z)) return fmt::format("has a height of {:g}, more than {:g}", z, largest_road_number);
    any = true;
  }
  for (const double at : road.line.reshaped())
    if (is_large(at)) return fmt::format("has a line that reaches {:g}, more than {:g}", at, largest_road_number);
  return any ? "" : "has no height";
}

std::ifstream open_road_file(const std::string& path, const std::string& remedy) {
  std::ifstream stream = open_table(path, remedy);
  std::error_code ignored;
  const std::uint64_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > most_road_bytes)
    throw Error(fmt::format("has {} bytes, more than {}", size, most_road_bytes), path, "thin it out");
  return stream;
}

}  // namespace tisserand::formats

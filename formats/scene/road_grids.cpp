// SPDX-License-Identifier: GPL-3.0-or-later
// Reads roads with heights over a grid: their keys and their files.

#include "formats/roads/crg.hpp"
#include "formats/roads/height_grid_file.hpp"
#include "formats/scene/reader.hpp"

namespace tisserand::formats {
namespace {

/// Reads an axis of a grid that the scene contains.
std::vector<double> read_grid_axis(const MapReader& map, const char* key) {
  const YamlNode* node = map.require(key);
  std::vector<double> axis = node == nullptr ? std::vector<double>{} : read_numbers(map.context(), *node, key);
  for (std::size_t i = 1; i < axis.size(); ++i) {
    if (axis[i] > axis[i - 1] || !std::isfinite(axis[i]) || !std::isfinite(axis[i - 1])) continue;
    map.context().fail(node->place, fmt::format("{} must increase, but {:g} follows {:g}", key, axis[i], axis[i - 1]),
                       "");
    break;
  }
  if (node != nullptr && axis.size() < 2)
    map.context().fail(node->place, fmt::format("{} has {} values", key, axis.size()), "give two or more");
  return axis;
}

/// Reads x, y, and z with a list for each x.
RoadHeights read_written_grid(const MapReader& map) {
  RoadHeights grid{read_grid_axis(map, "x"), read_grid_axis(map, "y"), {}, {}};
  const YamlNode* z = map.require("z");
  if (z == nullptr) return grid;
  const std::size_t rows = grid.along.size(), columns = grid.across.size();
  if (z->kind != YamlKind::sequence || z->children.size() != rows) {
    map.context().fail(z->place, fmt::format("z must be a list of {} lists, one for each x", rows), "");
    return grid;
  }
  grid.height.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  for (std::size_t i = 0; i < rows; ++i) {
    const std::vector<double> row = read_numbers(map.context(), z->children[i], fmt::format("z[{}]", i));
    if (row.size() != columns)
      map.context().fail(z->children[i].place,
                         fmt::format("z[{}] has {} heights instead of {}, one for each y", i, row.size(), columns), "");
    else
      grid.height.row(static_cast<Eigen::Index>(i)) =
          Eigen::Map<const Eigen::RowVectorXd>(row.data(), static_cast<Eigen::Index>(columns));
  }
  return grid;
}

std::optional<RegularGrid> read_regular_grid(const MapReader& map) {
  if (!map.has("x_start") && !map.has("y_start") && !map.has("spacing")) return std::nullopt;
  RegularGrid grid;
  for (const auto& [key, value] :
       {std::pair{"x_start", &grid.x_start}, std::pair{"y_start", &grid.y_start}, std::pair{"spacing", &grid.spacing}})
    if (const YamlNode* node = map.require(key)) *value = read_number(map.context(), *node, key);
  if (const YamlNode* node = map.find("spacing"); node != nullptr && grid.spacing <= 0.0)
    map.context().fail(node->place, fmt::format("spacing {:g} must be positive", grid.spacing), "");
  return grid;
}

/// Result of `read` for the file, or nothing and its error.
template <class Read>
std::optional<RoadHeights> read_road_file(const MapReader& map, const YamlNode& node, const Read& read) {
  const std::string name = read_text(map.context(), node, "file");
  if (name.empty()) return std::nullopt;
  try {
    return read((map.context().reader.folder() / name).string());
  } catch (const Error& error) {
    map.context().fail(node.place, error.what(), "");
    return std::nullopt;
  }
}

std::optional<RoadHeights> read_crg_road(const MapReader& map, const SceneDefinitions& definitions) {
  const YamlNode* file = map.require("file");
  const double metre = definitions.units.length.factor;
  if (!(metre > 0.0))
    map.fail("OpenCRG files are in metres, but the scene has no named units",
             "give units: {length: .., mass: .., time: ..}");
  if (file == nullptr || !(metre > 0.0)) return std::nullopt;
  return read_road_file(map, *file, [metre](const std::string& path) {
    RoadHeights road = read_crg(path);
    for (std::vector<double>* axis : {&road.along, &road.across})
      for (double& at : *axis) at /= metre;
    road.height /= metre;
    road.line /= metre;
    return road;
  });
}

std::optional<RoadHeights> read_grid_road(const MapReader& map) {
  const YamlNode* file = map.find("file");
  if (file == nullptr) {
    map.refuse({"x_start", "y_start", "spacing"}, "has no effect with 'z'", "remove it");
    return read_written_grid(map);
  }
  map.refuse({"x", "y", "z"}, "has no effect with 'file'", "remove it");
  const std::optional<RegularGrid> regular = read_regular_grid(map);
  if (regular && !(regular->spacing > 0.0)) return std::nullopt;
  return read_road_file(map, *file, [&regular](const std::string& path) { return read_height_grid(path, regular); });
}

}  // namespace

std::shared_ptr<const RoadHeights> read_road_heights(const MapReader& map, const SceneDefinitions& definitions,
                                                     RoadKind kind) {
  std::optional<RoadHeights> heights = kind == RoadKind::crg ? read_crg_road(map, definitions) : read_grid_road(map);
  return heights ? std::make_shared<const RoadHeights>(std::move(*heights)) : nullptr;
}

}  // namespace tisserand::formats

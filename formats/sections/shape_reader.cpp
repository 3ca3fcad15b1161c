// SPDX-License-Identifier: GPL-3.0-or-later
// Reads sizes, corners and walls of the shapes of sections.
#include "formats/sections/shape_reader.hpp"

#include <cmath>
#include <optional>

#include "formats/sections/monosymmetry.hpp"
#include "formats/sections/profiles.hpp"
#include "formats/sections/shapes.hpp"
#include "formats/sections/walls.hpp"
#include "formats/yaml/fields.hpp"

namespace tisserand::formats {
namespace {

const std::vector<std::string>& shape_words() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> all{"circle", "hollow_circle", "rectangle", "hollow_rectangle", "rod", "polygon", "walls"};
    for (const Profile& profile : profiles()) all.emplace_back(profile.shape);
    return all;
  }();
  return words;
}

std::string with_unit(double value, const Units& units) {
  return fmt::format("{:g}{}", value, after_number(unit_label(units, 1, 0, 0)));
}

/// A size of a shape, or nothing after an error.
std::optional<double> size(const MapReader& map, std::string_view key, const Units& units) {
  const double value = map.number(key);
  if (std::isnan(value)) return std::nullopt;
  if (value > 0.0) return value;
  map.context().fail(map.find(key)->place, fmt::format("{} {} must be positive", key, with_unit(value, units)), "");
  return std::nullopt;
}

Section read_circle(const MapReader& map, const Units& units) {
  const auto radius = size(map, "radius", units);
  return radius ? circle_section(*radius) : Section{};
}

Section read_hollow_circle(const MapReader& map, const Units& units) {
  const auto radius = size(map, "radius", units), thickness = size(map, "thickness", units);
  if (!radius || !thickness) return {};
  if (*thickness < *radius) return hollow_circle_section(*radius, *thickness);
  map.context().fail(map.find("thickness")->place,
                     fmt::format("thickness {} {} radius {}", with_unit(*thickness, units),
                                 *thickness > *radius ? "exceeds" : "equals", with_unit(*radius, units)),
                     "use a solid section or reduce thickness");
  return {};
}

Section read_rectangle(const MapReader& map, const Units& units) {
  const auto width = size(map, "width", units), height = size(map, "height", units);
  return width && height ? rectangle_section(*width, *height) : Section{};
}

Section read_hollow_rectangle(const MapReader& map, const Units& units) {
  const auto width = size(map, "width", units), height = size(map, "height", units);
  const auto thickness = size(map, "thickness", units);
  if (!width || !height || !thickness) return {};
  const double half = 0.5 * std::min(*width, *height);
  if (*thickness < half) return hollow_rectangle_section(*width, *height, *thickness);
  map.context().fail(map.find("thickness")->place,
                     fmt::format("thickness {} {} half of the {} {}", with_unit(*thickness, units),
                                 *thickness > half ? "exceeds" : "equals", *width <= *height ? "width" : "height",
                                 with_unit(2.0 * half, units)),
                     "use a solid section or reduce thickness");
  return {};
}

Section read_rod(const MapReader& map, const Units& units) {
  const auto area = size(map, "A", units);
  Section section;
  section.shape = "rod";
  section.area = area ? *area : 0.0;
  section.torsion_constant = map.number("J", 0.0);
  return section;
}

/// Point of the section on the axis of the beam. `origin` is for shapes with coordinates given by the user.
enum class AxisPoint { centroid, shear_center, origin };

void move_axis(AxisPoint axis, const Eigen::Vector2d& centroid, Section& section) {
  switch (axis) {
    case AxisPoint::centroid:
      return;
    case AxisPoint::shear_center:
      section.centroid_y = -section.shear_center_y;
      section.centroid_z = -section.shear_center_z;
      return;
    case AxisPoint::origin:
      section.centroid_y = centroid.x();
      section.centroid_z = centroid.y();
      return;
  }
}

constexpr Choice<AxisPoint> axis_choices[] = {
    {"centroid", AxisPoint::centroid}, {"shear_center", AxisPoint::shear_center}, {"origin", AxisPoint::origin}};
constexpr Choice<AxisPoint> profile_axis_choices[] = {{"centroid", AxisPoint::centroid},
                                                      {"shear_center", AxisPoint::shear_center}};

/// Reports an error if the section is too thin to compute its constants. Returns whether it is not.
bool resolved(const MapReader& map, const Section& section) {
  if (is_resolved(section)) return true;
  map.fail("parts of the section are too thin or too small, compared with the whole, to compute its torsion constant",
           "give it as `walls`, or give its constants");
  return false;
}

Section read_profile(const MapReader& map, const Profile& profile, const Units& units) {
  std::vector<double> sizes;
  for (const std::string_view key : profile.keys) {
    const bool like_the_top = profile.shape == "I" && key.starts_with("bottom_") && !map.has(key);
    const auto value = like_the_top ? std::optional(sizes[key == "bottom_width" ? 1 : 3]) : size(map, key, units);
    if (!value) return {};
    sizes.push_back(*value);
  }
  const AxisPoint axis = map.choice("axis", profile_axis_choices, AxisPoint::centroid);
  if (const auto fault = profile_fault(profile.shape, sizes)) {
    map.fail(*fault, "correct the sizes; heights and widths are outer ones");
    return {};
  }
  Section section = profile_section(profile.shape, sizes);
  if (!resolved(map, section)) return {};
  move_axis(axis, Eigen::Vector2d::Zero(), section);
  return section;
}

/// Points [y, z] of a list, or nothing after an error.
std::optional<Ring> read_ring(const Context& context, const YamlNode& node, const std::string& what) {
  if (node.kind != YamlKind::sequence) {
    context.fail(node.place, what + " is not a list of points", "write [[0, 0], [0.1, 0], [0, 0.1]]");
    return std::nullopt;
  }
  Ring ring;
  for (const YamlNode& child : node.children) {
    const std::vector<double> point = read_numbers(context, child, what);
    if (point.size() != 2) {
      context.fail(child.place, fmt::format("a point of {} has {} numbers", what, point.size()), "write [y, z]");
      return std::nullopt;
    }
    if (std::isnan(point[0]) || std::isnan(point[1])) return std::nullopt;
    ring.emplace_back(point[0], point[1]);
  }
  return ring;
}

Section read_polygon(const MapReader& map) {
  const YamlNode* outline = map.require("outline");
  const AxisPoint axis = map.choice("axis", axis_choices, AxisPoint::centroid);
  if (outline == nullptr) return {};
  const std::optional<Ring> outer = read_ring(map.context(), *outline, "outline");
  if (!outer) return {};
  SectionPolygon polygon{*outer, {}};
  if (const YamlNode* holes = map.find("holes")) {
    if (holes->kind != YamlKind::sequence) {
      map.context().fail(holes->place, "holes is not a list of holes",
                         "write [[[0.01, 0.01], [0.02, 0.01], [0.01, 0.02]]]");
      return {};
    }
    for (const YamlNode& child : holes->children) {
      const std::optional<Ring> hole = read_ring(map.context(), child, "holes");
      if (!hole) return {};
      polygon.holes.push_back(*hole);
    }
  }
  if (const auto fault = polygon_fault(polygon)) {
    map.context().fail(outline->place, *fault,
                       "give the corners in order, such that sides do not cross and holes lie inside the outline");
    return {};
  }
  Section section = polygon_section(polygon);
  if (!resolved(map, section)) return {};
  remember_outline(polygon, section);
  move_axis(axis, area_moments(polygon).centroid, section);
  return section;
}

std::optional<WallLine> read_wall_line(const Context& context, const YamlNode& node, const Units& units) {
  const MapReader line(context, node, "section_wall", "");
  const YamlNode* along = line.require("along");
  const auto thickness = size(line, "thickness", units);
  if (along == nullptr || !thickness) return std::nullopt;
  const std::optional<Ring> points = read_ring(context, *along, "along");
  if (!points) return std::nullopt;
  return WallLine{*points, *thickness};
}

Section read_walls(const MapReader& map, const Units& units) {
  const YamlNode* list = map.require("walls");
  const AxisPoint axis = map.choice("axis", axis_choices, AxisPoint::centroid);
  if (list == nullptr) return {};
  if (list->kind != YamlKind::sequence) {
    map.context().fail(list->place, "walls is not a list", "write [{along: [[0, 0], [0, 0.1]], thickness: 0.002}]");
    return {};
  }
  std::vector<WallLine> lines;
  for (const YamlNode& child : list->children) {
    const std::optional<WallLine> line = read_wall_line(map.context(), child, units);
    if (!line) return {};
    lines.push_back(*line);
  }
  if (const auto fault = walls_fault(lines)) {
    map.context().fail(list->place, *fault, "to join two lines, write the shared point in both");
    return {};
  }
  Section section = walls_section(lines);
  remember_outline(lines, section);
  move_axis(axis, walls_centroid(lines), section);
  return section;
}

}  // namespace

std::vector<KeySet> shape_key_sets() {
  const Field radius{"radius", "positive", "", "required"}, thickness{"thickness", "positive", "", "required"},
      width{"width", "positive", "", "required"}, height{"height", "positive", "", "required"},
      axis = words<axis_choices>("axis", "");
  std::vector<KeySet> sets{
      {"section_circle", {{"shape", "'circle'", "`radius`: `{shape: circle, radius: 0.01}`", "required"}, radius}},
      {"section_hollow_circle",
       {{"shape", "'hollow_circle'",
         "outer `radius`, `thickness` of the wall: `{shape: hollow_circle, radius: 0.05, thickness: 0.002}`",
         "required"},
        radius,
        thickness}},
      {"section_rectangle",
       {{"shape", "'rectangle'", "`width` along y, `height` along z: `{shape: rectangle, width: 0.02, height: 0.04}`",
         "required"},
        width,
        height}},
      {"section_hollow_rectangle",
       {{"shape", "'hollow_rectangle'",
         "outer `width` along y and `height` along z, `thickness`: `{shape: hollow_rectangle, width: 0.06, height: "
         "0.1, thickness: 0.003}`",
         "required"},
        width,
        height,
        thickness}}};
  struct Words {
    std::string noun, type;
  };
  static const std::vector<Words> profile_words = [] {
    std::vector<Words> all;
    for (const Profile& profile : profiles())
      all.push_back({fmt::format("section_{}", profile.shape), fmt::format("'{}'", profile.shape)});
    return all;
  }();
  for (std::size_t i = 0; i < profile_words.size(); ++i) {
    std::vector<Field> fields{{"shape", profile_words[i].type, profiles()[i].meaning, "required"}};
    for (const std::string_view key : profiles()[i].keys)
      fields.push_back({key, "positive", "", key.starts_with("bottom_") ? "" : "required"});
    fields.push_back(words<profile_axis_choices>("axis", ""));
    sets.push_back({profile_words[i].noun, fields});
  }
  sets.push_back({"section_polygon",
                  {{"shape", "'polygon'",
                    "`outline`: corners [y, z] in order; `holes`: lists of corners; 200 corners at most: `{shape: "
                    "polygon, outline: [[0, 0], [0.1, 0], [0, 0.05]]}`",
                    "required"},
                   {"outline", "section_ring", "", "required"},
                   {"holes", "[section_ring]", ""},
                   axis}});
  sets.push_back({"section_walls",
                  {{"shape", "'walls'",
                    "middle lines of thin walls: `along` points [y, z], `thickness`; joined where lines share a point: "
                    "`{shape: walls, walls: [{along: [[0.05, 0], [0, 0], [0, 0.1]], thickness: 0.002}]}`",
                    "required"},
                   {"walls", "[section_wall]1..", "", "required"},
                   axis}});
  sets.push_back({"section_wall", {{"along", "section_ring", "", "required"}, thickness}});
  sets.push_back({"section_rod",
                  {{"shape", "'rod'", "`A`, and `J` (default 0): no bending: `{shape: rod, A: 1e-4}`", "required"},
                   {"A", "positive", "", "required"},
                   {"J", "not_negative", ""}}});
  return sets;
}

Section read_shape(const Context& context, const YamlNode& node, const YamlNode& shape, const Units& units,
                   const std::string& prefix) {
  const auto index = read_word(context, shape, "shape", shape_words());
  if (!index) return {};
  const std::string& word = shape_words()[*index];
  const MapReader map(context, node, "section_" + word, prefix);
  if (word == "circle") return read_circle(map, units);
  if (word == "hollow_circle") return read_hollow_circle(map, units);
  if (word == "rectangle") return read_rectangle(map, units);
  if (word == "hollow_rectangle") return read_hollow_rectangle(map, units);
  if (word == "rod") return read_rod(map, units);
  if (word == "polygon") return read_polygon(map);
  if (word == "walls") return read_walls(map, units);
  return read_profile(map, *find_profile(word), units);
}

}  // namespace tisserand::formats

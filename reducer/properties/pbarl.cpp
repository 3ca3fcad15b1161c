// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of PBARL as polygons.
#include "reducer/properties/pbarl.hpp"

#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/text.hpp"
#include "formats/sections/profiles.hpp"
#include "formats/sections/shapes.hpp"

namespace tisserand::reducer {
namespace {

using formats::Ring;
using formats::Section;
using formats::SectionPolygon;
using Sizes = std::vector<double>;

const std::map<std::string_view, int>& size_counts() {
  static const std::map<std::string_view, int> counts{
      {"ROD", 1}, {"TUBE", 2}, {"TUBE2", 2}, {"BAR", 2}, {"BOX", 4},  {"BOX1", 6},  {"I", 6},
      {"I1", 4},  {"CHAN", 4}, {"CHAN1", 4}, {"T", 4},   {"T1", 4},   {"T2", 4},    {"CHAN2", 4},
      {"L", 4},   {"Z", 4},    {"H", 4},     {"HAT", 4}, {"HEXA", 3}, {"DBOX", 10}, {"CROSS", 4}};
  return counts;
}

/// Shape of formats/sections/profiles.hpp with its sizes, in the figure's axes (right, up), and quarter turns if the
/// figure shows it lying.
struct Drawn {
  std::string_view shape;
  Sizes sizes;
  int quarter_turns = 0;  ///< counter-clockwise
};

std::optional<Drawn> drawn_profile(std::string_view type, const Sizes& d) {
  if (type == "I") return Drawn{"I", {d[0], d[2], d[3], d[5], d[1], d[4]}};
  if (type == "I1") {
    const double width = d[0] + d[1], flange = 0.5 * (d[3] - d[2]);
    return Drawn{"I", {d[3], width, d[1], flange, width, flange}};
  }
  if (type == "H") return Drawn{"I", {d[0] + d[1], d[2], d[3], 0.5 * d[1], d[2], 0.5 * d[1]}, 1};
  if (type == "CHAN") return Drawn{"channel", {d[1], d[0], d[2], d[3]}};
  if (type == "CHAN1") return Drawn{"channel", {d[3], d[0] + d[1], d[1], 0.5 * (d[3] - d[2])}};
  if (type == "CHAN2") return Drawn{"channel", {d[3], d[2], d[1], d[0]}, 1};
  if (type == "T") return Drawn{"tee", {d[1], d[0], d[3], d[2]}};
  if (type == "T1") return Drawn{"tee", {d[1] + d[2], d[0], d[3], d[2]}, 3};
  if (type == "T2") return Drawn{"tee", {d[1], d[0], d[3], d[2]}, 2};
  if (type == "L") return Drawn{"angle", {d[1], d[0], d[3], d[2]}};
  if (type == "BOX") return Drawn{"box", {d[1], d[0], d[2], d[2], d[3], d[3]}};
  if (type == "BOX1") return Drawn{"box", {d[1], d[0], d[2], d[3], d[5], d[4]}};
  if (type == "HAT") return Drawn{"hat", {d[0], d[2], d[3], d[1]}};
  if (type == "CROSS") return Drawn{"cross", {d[2], d[0] + d[1], d[1], d[3]}};
  return std::nullopt;
}

/// Z with the top flange to the left and the bottom flange to the right: mirror image of the profile "zed".
SectionPolygon zed(const Sizes& d) {
  const double t = 0.5 * (d[3] - d[2]), w = 0.5 * d[1], b = d[0] + w, h = 0.5 * d[3];
  return {{{-w, -h}, {b, -h}, {b, t - h}, {w, t - h}, {w, h}, {-b, h}, {-b, h - t}, {-w, h - t}}, {}};
}

SectionPolygon hexagon(const Sizes& d) {
  const double a = 0.5 * d[1] - d[0], b = 0.5 * d[1], h = 0.5 * d[2];
  return {{{-a, -h}, {a, -h}, {b, 0}, {a, h}, {-a, h}, {-b, 0}}, {}};
}

SectionPolygon double_box(const Sizes& d) {
  const double middle = d[2], half = 0.5 * d[4];
  const auto cell = [](double left, double bottom, double right, double top) {
    return Ring{{left, bottom}, {right, bottom}, {right, top}, {left, top}};
  };
  return {cell(0, 0, d[0], d[1]),
          {cell(d[3], d[7], middle - half, d[1] - d[6]), cell(middle + half, d[9], d[0] - d[5], d[1] - d[8])}};
}

/// Polygon in (y, z) = (up, right) from the figure's axes (right, up), after the quarter turns.
SectionPolygon to_element_axes(SectionPolygon polygon, int quarter_turns) {
  const auto move = [quarter_turns](Ring& ring) {
    for (Eigen::Vector2d& p : ring) {
      for (int k = 0; k < quarter_turns; ++k) p = Eigen::Vector2d(-p.y(), p.x());
      p = Eigen::Vector2d(p.y(), p.x());
    }
  };
  move(polygon.outer);
  for (Ring& hole : polygon.holes) move(hole);
  return polygon;
}

std::string list_of_types() {
  std::vector<std::string> types;
  for (const auto& [type, count] : size_counts()) types.emplace_back(type);
  return "known are " + join(types, ", ");
}

[[noreturn]] void refuse(std::string_view type, const Sizes& sizes, const std::string& what, const std::string& where) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < sizes.size(); ++i) words.push_back(fmt::format("DIM{} = {:g}", i + 1, sizes[i]));
  throw Error(fmt::format("section type {}: {}; {}", type, what, join(words, ", ")), where,
              "correct the sizes; their order is that of the figures for PBARL in the manual of Nastran");
}

SectionPolygon polygon_of(std::string_view type, const Sizes& sizes, const std::string& where) {
  if (const std::optional<Drawn> drawn = drawn_profile(type, sizes)) {
    if (const auto fault = formats::profile_fault(drawn->shape, drawn->sizes)) refuse(type, sizes, *fault, where);
    return to_element_axes(formats::profile_polygon(drawn->shape, drawn->sizes), drawn->quarter_turns);
  }
  if (type == "Z" && !(sizes[3] > sizes[2])) refuse(type, sizes, "DIM4 must exceed DIM3", where);
  if (type == "HEXA" && !(sizes[1] > 2.0 * sizes[0])) refuse(type, sizes, "DIM2 must exceed 2 DIM1", where);
  const SectionPolygon polygon = type == "Z" ? zed(sizes) : type == "HEXA" ? hexagon(sizes) : double_box(sizes);
  if (const auto fault = formats::polygon_fault(polygon)) refuse(type, sizes, *fault, where);
  return to_element_axes(polygon, 0);
}

}  // namespace

int pbarl_sizes(std::string_view type) {
  const auto found = size_counts().find(type);
  return found == size_counts().end() ? 0 : found->second;
}

Section pbarl_section(std::string_view type, const Sizes& sizes, const std::string& where) {
  const int count = pbarl_sizes(type);
  if (count == 0) throw Error(fmt::format("section type '{}' is not known", type), where, list_of_types());
  if (count_of(sizes) != count) refuse(type, sizes, fmt::format("{} sizes instead of {}", sizes.size(), count), where);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const bool may_vanish = type == "TUBE" && i == 1;  // 0 means a full circle
    if (!std::isfinite(sizes[i]) || sizes[i] < 0.0 || (sizes[i] == 0.0 && !may_vanish))
      refuse(type, sizes, fmt::format("DIM{} {:g} must be positive", i + 1, sizes[i]), where);
  }
  Section section;
  if (type == "ROD" || (type == "TUBE" && sizes[1] == 0.0)) {
    section = formats::circle_section(sizes[0]);
  } else if (type == "TUBE" || type == "TUBE2") {
    const double thickness = type == "TUBE" ? sizes[0] - sizes[1] : sizes[1];
    if (!(thickness > 0.0 && thickness <= sizes[0])) refuse(type, sizes, "the wall is not inside the radius", where);
    section =
        thickness == sizes[0] ? formats::circle_section(sizes[0]) : formats::hollow_circle_section(sizes[0], thickness);
  } else if (type == "BAR") {
    section = formats::rectangle_section(sizes[1], sizes[0]);
  } else {
    section = formats::polygon_section(polygon_of(type, sizes, where));
    if (!formats::is_resolved(section))
      refuse(type, sizes, "the walls are too thin to compute the torsion constant", where);
  }
  section.where = where;
  return section;
}

Section on_bar_axis(Section section) {
  section.centroid_y = section.centroid_z = section.shear_center_y = section.shear_center_z = 0.0;
  return section;
}

Section on_shear_axis(Section section) {
  section.centroid_y = -section.shear_center_y;
  section.centroid_z = -section.shear_center_z;
  return section;
}

}  // namespace tisserand::reducer

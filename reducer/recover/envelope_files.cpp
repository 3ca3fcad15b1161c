// SPDX-License-Identifier: GPL-3.0-or-later
// Files of the envelope: a table of elements, and fields on the mesh at rest.
#include <cmath>

#include <fmt/format.h>

#include "common/program/version.hpp"
#include "common/text.hpp"
#include "reducer/recover/envelope.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using formats::Recovery;
using formats::VtuArray;

constexpr std::size_t flush_bytes = 1u << 20;
constexpr double round_off = 1e-12;  // for corners of circles

/// Text as a quoted cell of CSV.
std::string quoted(const std::string& text) {
  std::string cell = "\"";
  for (const char c : printable_line(text, 200)) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + "\"";
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return quoted(unit.empty() ? name : name + " [" + unit + "]");
}

const char* kind_of(const Recovery& r, int element) {
  return element < r.beams() ? "beam" : element < r.beams() + r.shells() ? "shell" : "solid";
}

std::string header_of(const Units& units) {
  const std::string length = unit_label(units, 1, 0, 0), time = unit_label(units, 0, 0, 1),
                    stress = unit_label(units, -1, 1, -2);
  std::string text =
      "element,group,kind," + with_unit("x", length) + ',' + with_unit("y", length) + ',' + with_unit("z", length);
  for (const char* name : {"von_mises", "largest_principal", "smallest_principal"})
    text += ',' + with_unit(name, stress) + ',' + with_unit(std::string(name) + "_time", time) + ',' + name + "_place";
  return text + '\n';
}

/// Cells ",value,time,place", empty if the element has no stress.
std::string cells_of(const Recovery& r, int element, const ExtremeOverTime& over_time, const MotionReader& motion) {
  const int instant = over_time.instant(element);
  if (instant < 0) return ",,,";
  const auto value = static_cast<double>(over_time.value(element));
  return fmt::format(",{:.7g},{:.12g},{}", value == 0.0 ? 0.0 : value, motion.time()[instant],
                     quoted(place_text(r, element, over_time.place(element), motion.still().to_scene.length)));
}

std::vector<float> times_of(const ExtremeOverTime& over_time, const MotionReader& motion) {
  std::vector<float> times;
  for (int i = 0; i < over_time.items(); ++i)
    times.push_back(over_time.instant(i) < 0 ? 0.0f : static_cast<float>(motion.time()[over_time.instant(i)]));
  return times;
}

/// Places in the numbering of VTU files: faces of shells and ends of beams 1 and 2, nodes of solids from 1; 0: none.
std::vector<float> places_of(const Recovery& r, const ExtremeOverTime& over_time) {
  std::vector<float> places;
  for (int e = 0; e < r.elements.count(); ++e) {
    const int place = over_time.place(e), end = place % 2 == 1 ? 1 : 2;
    places.push_back(static_cast<float>(over_time.instant(e) < 0 ? 0 : e < r.beams() ? end : place));
  }
  return places;
}

/// Extreme over the stress points of each node; 0 for nodes without points.
std::vector<float> on_nodes(const Recovery& r, const ExtremeOverTime& points) {
  ExtremeOverTime nodes(points.kind(), r.nodes());
  for (int p = 0; p < r.stress_points(); ++p)
    if (points.instant(p) >= 0) nodes.take(r.stress_node[p], {points.value(p), 0}, points.instant(p));
  return nodes.values();
}

}  // namespace

std::string place_text(const Recovery& r, int element, int place, double length) {
  if (element < r.beams()) {
    const int end = place % 2 == 1 ? 1 : 2, corner = (place - end) / 2;
    const std::vector<Eigen::Vector2d>& outline = r.sections[r.beam_section[2 * element + end - 1]].outline;
    if (corner < 0 || corner >= count_of(outline)) return fmt::format("end {}", end);
    Eigen::Vector2d at = length * outline[corner];
    for (double& value : at)
      if (std::abs(value) < round_off * at.norm()) value = 0.0;
    return fmt::format("end {} (y {:.4g}, z {:.4g})", end, at.x(), at.y());
  }
  if (element < r.beams() + r.shells()) return place == 1 ? "top" : "bottom";
  const int node = r.elements.first[element] + place - 1;
  return r.node_label[r.elements.node[node]];
}

void write_envelope_csv(const std::string& path, const Recovery& r, const MotionReader& motion,
                        const Envelope& envelope) {
  TextFile file(path);
  std::string text = header_of(motion.still().scene_units);
  const Eigen::Vector3d to_body = motion.still().to_scene.length * motion.still().mirror;
  for (int e = 0; e < r.elements.count(); ++e) {
    const auto element = static_cast<std::size_t>(e);
    const Eigen::Vector3d middle = to_body.cwiseProduct(element_middle(r, e));
    text +=
        fmt::format("{},{},{},{:.9g},{:.9g},{:.9g}", r.elements.id[element],
                    quoted(r.group_name[r.elements.group[element]]), kind_of(r, e), middle.x(), middle.y(), middle.z());
    text += cells_of(r, e, envelope.element.von_mises, motion) + cells_of(r, e, envelope.element.largest, motion) +
            cells_of(r, e, envelope.element.smallest, motion) + '\n';
    if (text.size() < flush_bytes) continue;
    file.write(text);
    text.clear();
  }
  file.write(text);
  file.publish();
}

void write_envelope_vtu(const std::string& path, const Recovery& r, const MotionReader& motion,
                        const formats::VtuCells& cells, const Envelope& envelope) {
  const Eigen::Vector3d to_body = motion.still().to_scene.length * motion.still().mirror;
  const Eigen::Matrix3Xf X = (to_body.asDiagonal() * r.position).cast<float>();
  std::vector<VtuArray> points{{"displacement", 1, envelope.displacement.values()},
                               {"displacement_time", 1, times_of(envelope.displacement, motion)}};
  if (r.stress_points() > 0) {
    points.push_back({"solid_von_mises", 1, on_nodes(r, envelope.point.von_mises)});
    points.push_back({"solid_largest_principal", 1, on_nodes(r, envelope.point.largest)});
    points.push_back({"solid_smallest_principal", 1, on_nodes(r, envelope.point.smallest)});
  }
  std::vector<VtuArray> on_cells;
  const auto add = [&](const std::string& name, const ExtremeOverTime& over_time) {
    on_cells.push_back({name, 1, over_time.values()});
    on_cells.push_back({name + "_time", 1, times_of(over_time, motion)});
    on_cells.push_back({name + "_place", 1, places_of(r, over_time)});
  };
  add("von_mises", envelope.element.von_mises);
  add("largest_principal", envelope.element.largest);
  add("smallest_principal", envelope.element.smallest);
  on_cells.push_back({"group", 1, {r.elements.group.begin(), r.elements.group.end()}});
  formats::write_vtu(path, producer("reducer"), X, cells, points, on_cells);
}

}  // namespace tisserand::reducer

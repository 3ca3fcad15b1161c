// SPDX-License-Identifier: GPL-3.0-or-later
// Points, patches and beams of the part file as nodes and elements.
#include <set>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/elements/beam/beam.hpp"
#include "reducer/properties/beam_taper.hpp"
#include "reducer/sources/lines.hpp"
#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/places.hpp"

namespace tisserand::reducer {
namespace {

template <class Named>
const Named& find_named(const std::vector<Named>& all, const std::string& name, const char* kind,
                        const formats::BeamLine& line) {
  std::vector<std::string> known;
  for (const Named& item : all) {
    if (item.name == name) return item;
    known.push_back(item.name);
  }
  const std::optional<std::string> guess = nearest(name, known);
  throw Error(fmt::format("beam '{}': {} '{}' does not exist", line.name, kind, name), line.where,
              guess ? fmt::format("did you mean '{}'?", *guess) : "known are " + listed(known));
}

/// Names of points at which beams, springs and spiders end; only these become nodes.
std::set<std::string> used_points(const formats::Part& part) {
  std::set<std::string> names;
  const auto use = [&names](const formats::Place& place) {
    if (place.kind == formats::PlaceKind::name) names.insert(place.name);
  };
  for (const formats::BeamLine& beam : part.beams)
    if (beam.on.empty()) use(beam.from), use(beam.to);
  for (const formats::SpringLine& spring : part.springs) use(spring.from), use(spring.to);
  for (const formats::SpiderLine& spider : part.spiders) use(spider.at);
  return names;
}

/// Nodes along a line; inner ones are merged with nodes of patches at the same place.
std::vector<int> nodes_along(MeshBuilder& builder, const formats::BeamLine& line, const Curve& curve, int first,
                             int last) {
  const int elements = element_count(curve, line);
  std::vector<int> nodes{first};
  for (int k = 1; k < elements; ++k) {
    const Eigen::Vector3d x = curve.at(static_cast<double>(k) / elements);
    const int on_patch = builder.patch_nodes.find(x);
    nodes.push_back(on_patch >= 0 ? on_patch : builder.add_node(x, fmt::format("{}[{}]", line.name, k)));
  }
  nodes.push_back(last);
  return nodes;
}

std::vector<Eigen::Vector3d> tangents(const MeshBuilder& builder, const std::vector<int>& nodes) {
  std::vector<Eigen::Vector3d> result;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    result.push_back((builder.position(nodes[k + 1]) - builder.position(nodes[k])).normalized());
  return result;
}

void add_line_elements(MeshBuilder& builder, const formats::BeamLine& line, const std::vector<int>& nodes) {
  const Eigen::Vector3d orientation =
      line.orientation ? *line.orientation : default_orientation(tangents(builder, nodes));
  const BeamElementData data = beam_data(builder.part, line);
  const int elements = count_of(nodes) - 1;
  std::vector<formats::Section> stations;
  if (!line.to_section.empty())
    stations = taper_stations(data.section, find_named(builder.part.sections, line.to_section, "section", line));
  else
    builder.mesh.beam_properties.push_back({data, line.name});
  for (int e = 0; e < elements; ++e) {
    const double from = static_cast<double>(e) / elements, to = static_cast<double>(e + 1) / elements;
    if (!stations.empty()) {
      builder.mesh.beam_properties.push_back({data, line.name});
      builder.mesh.beam_properties.back().data.stations = stations_between(stations, from, to);
    }
    builder.mesh.beams.push_back(beam_element(builder, line, {nodes[e], nodes[e + 1], from, to, e + 1}, orientation));
  }
  builder.mesh.beams[builder.mesh.beams.size() - static_cast<std::size_t>(elements)].released |=
      static_cast<std::uint16_t>(line.releases.start);
  builder.mesh.beams.back().released |= static_cast<std::uint16_t>(line.releases.end << 6U);
}

}  // namespace

int MeshBuilder::add_node(const Eigen::Vector3d& x, std::string name) {
  cells.position.push_back(x);
  cells.node_id.push_back(-1);
  label.push_back(std::move(name));
  return count_of(cells.position) - 1;
}

BeamElementData beam_data(const formats::Part& part, const formats::BeamLine& line) {
  BeamElementData data;
  data.section = find_named(part.sections, line.section, "section", line);
  data.material = data.section.by_stiffness ? formats::unit_material(line.where)
                                            : find_named(part.materials, line.material, "material", line);
  data.theory = line.theory;
  data.mass_matrix = line.mass_matrix;
  data.rotary_inertia = line.rotary_inertia ? RotaryInertia::with : RotaryInertia::without;
  return data;
}

BeamElement beam_element(const MeshBuilder& builder, const formats::BeamLine& line, const BeamPlace& place,
                         const Eigen::Vector3d& orientation) {
  const auto offset = [&line](double s) -> Eigen::Vector3d {
    return (1.0 - s) * line.from_offset + s * line.to_offset;
  };
  BeamElement beam;
  beam.first = place.first_node;
  beam.second = place.second_node;
  beam.property = count_of(builder.mesh.beam_properties) - 1;
  beam.first_offset = offset(place.from);
  beam.second_offset = offset(place.to);
  beam.id = place.number;
  const Eigen::Vector3d axis =
      builder.position(beam.second) + beam.second_offset - builder.position(beam.first) - beam.first_offset;
  const std::optional<Eigen::Matrix3d> R_PE = axis.norm() > 0.0 ? beam_axes(axis, orientation) : std::nullopt;
  if (!R_PE)
    throw Error(axis.norm() > 0.0
                    ? fmt::format("beam '{}': orientation ({:g}, {:g}, {:g}) is parallel to the beam at element {}",
                                  line.name, orientation.x(), orientation.y(), orientation.z(), place.number)
                    : fmt::format("beam '{}': element {} has zero length", line.name, place.number),
                line.where,
                "give an orientation that is nowhere parallel to the beam, and offsets that keep its length above 0");
  beam.R_PE = *R_PE * Eigen::AngleAxisd(line.angle, Eigen::Vector3d::UnitX());
  return beam;
}

void add_patches(MeshBuilder& builder) {
  PatchMesh patches = mesh_patches(builder.part);
  builder.cells = std::move(patches.cells);
  builder.label = std::move(patches.label);
  builder.patch_nodes = std::move(patches.nodes);
}

void add_points(MeshBuilder& builder) {
  const std::set<std::string> used = used_points(builder.part);
  for (const formats::NamedPoint& point : builder.part.points) {
    if (point.place) continue;
    const int on_patch = builder.patch_nodes.find(point.position);
    if (on_patch >= 0) builder.label[on_patch] = point.name;
    if (on_patch >= 0)
      builder.point_node[point.name] = on_patch;
    else if (used.contains(point.name))
      builder.point_node[point.name] = builder.add_node(point.position, point.name);
  }
}

void add_beams(MeshBuilder& builder) {
  for (const formats::BeamLine& line : builder.part.beams) {
    builder.beam_nodes.emplace_back();
    if (!line.on.empty()) continue;
    const std::string user = fmt::format("beam '{}'", line.name);
    const int first = find_place(builder, line.from, {user, line.where}),
              last = find_place(builder, line.to, {user, line.where});
    const Curve curve = curve_of(line, builder.position(first), builder.position(last));
    builder.beam_nodes.back() = nodes_along(builder, line, curve, first, last);
    add_line_elements(builder, line, builder.beam_nodes.back());
  }
  check_conformity(builder.part, builder.cells, {builder.cells.position, builder.label, builder.beam_nodes});
}

}  // namespace tisserand::reducer

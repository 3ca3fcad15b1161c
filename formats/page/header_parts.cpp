// SPDX-License-Identifier: GPL-3.0-or-later
// Writes surfaces and units as objects of the header.
#include "formats/page/header_parts.hpp"

#include <Eigen/Geometry>

namespace tisserand::formats {
namespace {

using Eigen::Vector3d;

std::vector<std::uint32_t> flat(const auto& faces) {
  std::vector<std::uint32_t> indices;
  for (const auto& face : faces)
    for (const int corner : face) indices.push_back(static_cast<std::uint32_t>(corner));
  return indices;
}

std::vector<std::uint32_t> flat(const std::vector<int>& numbers) { return {numbers.begin(), numbers.end()}; }

/// Adds modes of displacement. If vertices have three rows each, adds modes of stress too.
void add_deformation(const PageShape& shape, const FewModes& few, PageBlocks& blocks, Json& json) {
  const Eigen::Index vertices = shape.surface.size(), rows = few.modes.rows() / few.count();
  if (rows == vertices) {
    json["modes"] = blocks.add_modes(few.modes, few.step);
    return;
  }
  PageRows moved(vertices * few.count(), 3), stressed(2 * vertices * few.count(), 3);
  for (Eigen::Index k = 0; k < few.count(); ++k) {
    moved.middleRows(k * vertices, vertices) = few.modes.middleRows(k * rows, vertices);
    stressed.middleRows(2 * k * vertices, 2 * vertices) =
        few.modes.middleRows(k * rows + vertices, 2 * vertices) / shape.stress_scale;
  }
  json["modes"] = blocks.add_modes(moved, few.step);
  std::vector<double> step = few.step;
  for (double& one : step) one /= shape.stress_scale;
  const Json modes = blocks.add_modes(Eigen::Map<const PageRows>(stressed.data(), stressed.rows() / 2, 6), step);
  json["stress"] = {{"quantity", "von Mises"}, {"modes", modes}};
}

}  // namespace

double size_of(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : surface.vertices) box.extend(vertex);
  return surface.vertices.empty() ? 0.0 : box.diagonal().norm();
}

Json shape_json(const PageShape& shape, const FewModes& few, PageBlocks& blocks) {
  Json json{{"vertices", nullptr}, {"triangles", nullptr}, {"lines", nullptr},       {"points", shape.points},
            {"modes", nullptr},    {"stress", nullptr},    {"source", shape.source}, {"thinned", nullptr}};
  json["largest"] = few.largest;
  json["error"] = few.error;
  const Surface& surface = shape.surface;
  if (surface.vertices.empty()) return json;
  PageRows vertices(surface.size(), 3);
  for (int i = 0; i < surface.size(); ++i) vertices.row(i) = surface.vertices[i].transpose();
  json["vertices"] = blocks.add_positions(vertices);
  if (!surface.triangles.empty()) json["triangles"] = blocks.add_indices(flat(surface.triangles), 3);
  if (shape.elements.size() == surface.triangles.size() && !shape.elements.empty())
    json["elements"] = blocks.add_indices(flat(shape.elements), 1);
  if (!surface.lines.empty()) json["lines"] = blocks.add_indices(flat(surface.lines), 2);
  if (few.count() > 0) add_deformation(shape, few, blocks, json);
  if (shape.all_vertices > surface.size())
    json["thinned"] = {{"vertices", shape.all_vertices}, {"kept", surface.size()}};
  return json;
}

Json units_json(const Units& units) {
  const std::string moment = unit_label(units, 2, 1, -2), force = unit_label(units, 1, 1, -2);
  return {{"length", unit_label(units, 1, 0, 0)},
          {"time", unit_label(units, 0, 0, 1)},
          {"angle", "rad"},
          {"force", force},
          {"moment", moment},
          {"stress", unit_label(units, -1, 1, -2)},
          {"energy", energy_label(units)},
          {"mass", unit_label(units, 0, 1, 0)}};
}

Json pascal_json(const Units& units) {
  if (!units.named()) return nullptr;
  return units.mass.factor / (units.length.factor * units.time.factor * units.time.factor);
}

}  // namespace tisserand::formats

// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh of a part: its steps in their order.
#include "reducer/sources/build_mesh.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/stable_sort.hpp"
#include "common/text.hpp"
#include "reducer/mesh/mesh_file.hpp"
#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/node_references.hpp"
#include "reducer/ties/spring_turns.hpp"

namespace tisserand::reducer {
namespace {

/// Warns of removed nodes of a deck, which may be there by mistake; a geometry always has unused points.
void report_omissions(MeshBuilder& builder, const std::vector<int>& row) {
  constexpr int most_listed = 10;
  std::vector<std::string> reported;
  int count = 0;
  for (int n = builder.first_file_node; n < builder.last_file_node; ++n)
    if (row[n] < 0 && !builder.merged.contains(n) && count++ < most_listed) reported.push_back(builder.label[n]);
  if (count > 0)
    builder.mesh.warnings.push_back(fmt::format("{} nodes of {} have no element, mass or tie and are omitted: {}",
                                                count, builder.part.mesh.file,
                                                listed(reported, ", ", static_cast<std::size_t>(count))));
}

FacePlace place_of(const CellMesh& cells, const Entity& face) {
  const std::span<const Cell> own(cells.cells[2].data() + face.first, face.count);
  const auto middle = [&](const Cell& cell) { return middle_of(cell, cells.position); };
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Cell& cell : own) mean += middle(cell) / static_cast<double>(face.count);
  const Cell& nearest =
      *std::ranges::min_element(own, {}, [&](const Cell& cell) { return (middle(cell) - mean).norm(); });
  return {name_of(face), middle(nearest)};
}

std::vector<FacePlace> face_places(const CellMesh& cells, std::size_t most) {
  std::vector<const Entity*> faces;
  for (const Entity& entity : cells.entities)
    if (entity.dimension == 2 && entity.count > 0) faces.push_back(&entity);
  sort_stably(faces, std::greater{}, &Entity::count);
  if (faces.size() > most) faces.resize(most);
  std::vector<FacePlace> places;
  for (const Entity* face : faces) places.push_back(place_of(cells, *face));
  return places;
}

/// Part with the faces of its geometry or mesh file as shells, for viewing, if it uses none of its elements.
formats::Part with_skin(formats::Part part) {
  if (part.mesh.file.empty() || !part.shells.empty() || !part.solids.empty() || !part.beams.empty() ||
      !part.patches.empty())
    return part;
  const MeshFileKind kind = mesh_file_kind(part.mesh.file, part.mesh.where);
  if (kind == MeshFileKind::nastran || kind == MeshFileKind::abaqus) return part;
  formats::Material material = formats::unit_material(part.file);
  material.name = "any";
  part.materials.push_back(material);
  formats::ShellGroup faces;
  faces.name = "faces";
  faces.on = {"all"};
  faces.layout.thickness = 1.0;
  faces.layout.material = material.name;
  faces.where = part.file;
  part.shells.push_back(faces);
  return part;
}

/// All steps except the last.
void build(MeshBuilder& builder) {
  const formats::Part& part = builder.part;
  if (part.beams.empty() && part.patches.empty() && part.mesh.file.empty())
    throw Error("the part has no elements", part.file, "give beams, plates or a mesh file");
  add_patches(builder);
  add_points(builder);
  add_mesh_file(builder);
  add_group_elements(builder);
  add_spider_nodes(builder);
  add_beams(builder);
  add_attachments(builder);
  if (builder.mesh.elements() == 0)
    throw Error("the mesh has no elements with a property", part.file,
                "give properties to the groups of the mesh file under shells, solids or beams");
  add_loads(builder);
  report_unjoined_beams(builder);
  join_coincident_nodes(builder);
  report_hanging_nodes(builder);
}

}  // namespace

/// Removes nodes without references (points of a geometry, orientation nodes of a deck); the others keep their order.
void finish(MeshBuilder& builder) {
  Mesh& mesh = builder.mesh;
  std::vector<int> row(builder.cells.position.size(), -1);
  for_nodes(mesh, [&row](int& node) { row[node] = 0; });
  if (builder.file_is_deck) report_omissions(builder, row);
  int count = 0;
  for (int& r : row)
    if (r == 0) r = count++;
  mesh.position.resize(3, count);
  mesh.node_label.resize(static_cast<std::size_t>(count));
  for (std::size_t n = 0; n < row.size(); ++n) {
    if (row[n] < 0) continue;
    mesh.position.col(row[n]) = builder.cells.position[n];
    mesh.node_label[row[n]] = std::move(builder.label[n]);
  }
  if (!builder.node_of_id.empty()) mesh.node_number.assign(static_cast<std::size_t>(count), 0);
  for (const auto& [number, node] : builder.node_of_id) {
    const int own = row[node];
    if (own < 0 || number <= 0 || number > std::numeric_limits<int>::max()) continue;
    int& least = mesh.node_number[own];  // merged nodes have several
    if (least == 0 || number < least) least = static_cast<int>(number);
  }
  for_nodes(mesh, [&row](int& node) { node = row[node]; });
  turn_springs(mesh);
}

Mesh build_mesh(const formats::Part& part) {
  MeshBuilder builder(part);
  build(builder);
  finish(builder);
  return std::move(builder.mesh);
}

Mesh build_mesh_to_solve(const formats::Part& part) {
  MeshBuilder builder(part);
  builder.needs_boundary = false;
  build(builder);
  finish(builder);
  return std::move(builder.mesh);
}

Mesh build_mesh(const formats::Part& part, std::size_t most, std::vector<FacePlace>& faces) {
  const formats::Part seen = with_skin(part);
  MeshBuilder builder(seen);
  builder.needs_boundary = false;
  build(builder);
  faces = face_places(builder.cells, most);
  finish(builder);
  return std::move(builder.mesh);
}

}  // namespace tisserand::reducer

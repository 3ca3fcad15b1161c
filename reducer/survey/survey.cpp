// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of entities, groups and sets.
#include "reducer/survey/survey.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "common/stable_sort.hpp"
#include "reducer/faces/outward.hpp"
#include "reducer/mesh/mesh_file.hpp"
#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/selection.hpp"
#include "reducer/survey/form_table.hpp"

namespace tisserand::reducer {
namespace {

struct Row {
  std::string name;
  std::string kind;
  std::size_t elements = 0;
  double size = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
};

/// Data of the geometry kernel for an entity, or null.
const EntityGeometry* geometry_at(const MeshBuilder& builder, int entity) {
  const auto e = static_cast<std::size_t>(entity);
  return e < builder.cells.geometry.size() ? &builder.cells.geometry[e] : nullptr;
}

/// Size and middle of all entities, if the kernel has those of each; otherwise size 0.
EntityGeometry exact_size(const MeshBuilder& builder, const std::vector<int>& entities) {
  EntityGeometry sum;
  for (const int e : entities) {
    const EntityGeometry* geometry = geometry_at(builder, e);
    if (geometry == nullptr || !(geometry->size > 0.0)) return {};
    sum.size += geometry->size;
    sum.center += geometry->size * geometry->center;
  }
  if (sum.size > 0.0) sum.center /= sum.size;
  return sum;
}

/// Table row with size, centre and box from the nodes' shares.
Row row_of(const MeshBuilder& builder, const std::string& name, const std::string& kind, const Selection& selection) {
  Row row;
  row.name = name;
  row.kind = kind;
  for (const int e : selection.entities) row.elements += builder.cells.entities[e].count;
  const ElementSet& set = selection.elements;
  row.elements += set.beams.size() + set.shells.size() + set.solids.size() + set.springs.size();
  for (const auto& [node, weight] : node_weights(builder, selection)) {
    const Eigen::Vector3d& x = builder.position(node);
    row.size += weight;
    row.center += weight * x;
    row.low = row.low.cwiseMin(x);
    row.high = row.high.cwiseMax(x);
  }
  if (row.size > 0.0) row.center /= row.size;
  const EntityGeometry exact = exact_size(builder, selection.entities);
  if (exact.size > 0.0 && selection.nodes.empty()) row.size = exact.size, row.center = exact.center;
  return row;
}

std::string table(const std::string& title, const std::vector<Row>& rows) {
  if (rows.empty()) return "";
  std::size_t width = 10;
  for (const Row& row : rows) width = std::max(width, row.name.size());
  std::string result =
      fmt::format("{:<{}}  {:<7} {:>9} {:>11}  {:<30} box\n", title, width, "kind", "elements", "size", "centre");
  for (const Row& row : rows)
    result += fmt::format("{:<{}}  {:<7} {:>9} {:>11.4g}  {:<30} {} {}\n", row.name, width, row.kind, row.elements,
                          row.size, point_text(row.center), point_text(row.low), point_text(row.high));
  return result + "\n";
}

std::vector<Row> entity_rows(const MeshBuilder& builder) {
  std::vector<Row> rows;
  for (int e = 0; e < std::ssize(builder.cells.entities); ++e) {
    const Entity& entity = builder.cells.entities[e];
    if (entity.count > 0)
      rows.push_back(row_of(builder, name_of(entity), dimension_word(entity.dimension), {{e}, {}, {}}));
  }
  sort_stably(rows, {}, &Row::kind);
  return rows;
}

struct NamedGroup {
  std::string name;
  std::string kind;
  Selection selection;
};

std::vector<NamedGroup> named_groups(const MeshBuilder& builder) {
  std::vector<NamedGroup> groups;
  for (const EntityGroup& group : builder.cells.groups)
    groups.push_back({group.name, dimension_word(group.dimension), {group.entities, {}, {}}});
  for (const formats::GroupDefinition& group : builder.part.groups)
    groups.push_back({group.name, dimension_word(static_cast<int>(group.of)),
                      select(builder, group.name, -1, {fmt::format("group '{}'", group.name), group.where})});
  for (const auto& [name, set] : builder.element_sets) groups.push_back({name, "set", {{}, set, {}}});
  for (const auto& [name, nodes] : builder.node_sets) groups.push_back({name, "nodes", {{}, {}, nodes}});
  return groups;
}

std::vector<Row> group_rows(const MeshBuilder& builder, const std::vector<NamedGroup>& groups) {
  std::vector<Row> rows;
  for (const NamedGroup& group : groups) rows.push_back(row_of(builder, group.name, group.kind, group.selection));
  return rows;
}

void append_cells(FaceCells& to, const FaceCells& from) {
  to.cells.insert(to.cells.end(), from.cells.begin(), from.cells.end());
  to.sign.insert(to.sign.end(), from.sign.begin(), from.sign.end());
}

/// Cells of the faces in the selection.
FaceCells cells_of(const MeshBuilder& builder, const std::vector<int>& signs, const Selection& selection) {
  FaceCells face;
  for (const int e : selection.entities) {
    const Entity& entity = builder.cells.entities[e];
    if (entity.dimension != 2) continue;
    const auto first = static_cast<std::ptrdiff_t>(entity.first),
               last = first + static_cast<std::ptrdiff_t>(entity.count);
    const std::vector<Cell>& cells = builder.cells.cells[2];
    append_cells(face, {{cells.begin() + first, cells.begin() + last}, {signs.begin() + first, signs.begin() + last}});
  }
  for (const int e : selection.elements.shells) append_cells(face, {{shell_cell(builder.mesh.shells[e])}, {0}});
  if (!selection.nodes.empty()) append_cells(face, faces_between(builder, selection.nodes));
  return face;
}

/// Points of all faces in the selection, if each has some, and their size and middle.
EntityGeometry exact_face(const MeshBuilder& builder, const Selection& selection) {
  if (!selection.elements.shells.empty() || !selection.nodes.empty()) return {};
  EntityGeometry exact = exact_size(builder, selection.entities);
  for (const int e : selection.entities) {
    const EntityGeometry* geometry = geometry_at(builder, e);
    if (geometry == nullptr || geometry->point.empty()) return {};
    exact.point.insert(exact.point.end(), geometry->point.begin(), geometry->point.end());
    exact.normal.insert(exact.normal.end(), geometry->normal.begin(), geometry->normal.end());
  }
  return exact;
}

SurveyedFace face_of(const MeshBuilder& builder, const std::vector<int>& signs, const std::string& name,
                     const Selection& selection) {
  SurveyedFace face{name, name, cells_of(builder, signs, selection), {}};
  face.facts = face_facts(face.cells, builder.cells.position, exact_face(builder, selection));
  return face;
}

std::vector<SurveyedFace> numbered_faces(const MeshBuilder& builder, const std::vector<int>& signs) {
  std::vector<SurveyedFace> faces;
  for (int e = 0; e < std::ssize(builder.cells.entities); ++e) {
    const Entity& entity = builder.cells.entities[e];
    if (entity.dimension != 2 || entity.count == 0) continue;
    faces.push_back(face_of(builder, signs, name_of(entity), {{e}, {}, {}}));
    if (entity.number > 0) faces.back().label = std::to_string(entity.number);
  }
  return faces;
}

std::vector<SurveyedFace> face_groups(const MeshBuilder& builder, const std::vector<int>& signs,
                                      const std::vector<NamedGroup>& groups) {
  std::vector<SurveyedFace> faces;
  for (const NamedGroup& group : groups) {
    SurveyedFace face = face_of(builder, signs, group.name, group.selection);
    if (!face.cells.cells.empty()) faces.push_back(std::move(face));
  }
  return faces;
}

bool is_geometry(const formats::Part& part) {
  return !part.mesh.file.empty() && is_geometry(mesh_file_kind(part.mesh.file, part.mesh.where));
}

std::string unit_of_lengths(const formats::Part& part) {
  if (part.units.named()) return part.units.length.label;
  if (part.mesh.file.empty()) return "units of the part";
  const MeshFileKind kind = mesh_file_kind(part.mesh.file, part.mesh.where);
  // OpenCASCADE converts to this unit
  if (kind == MeshFileKind::step || kind == MeshFileKind::iges) return "mm";
  return "units of the file (it does not name them)";
}

}  // namespace

formats::Part part_of_file(const std::string& file) {
  formats::Part part;
  part.name = file;
  part.file = file;
  part.units = Units::consistent();
  part.mesh.file = file;
  part.mesh.where = file;
  part.mesh.unknown = formats::UnknownContent::ignore;
  return part;
}

formats::Part finely_meshed(const formats::Part& part) {
  constexpr int cells_per_turn = 30;
  formats::Part result = part;
  if (is_geometry(part) && !(part.mesh.size > 0.0) && part.mesh.curvature == 0) result.mesh.curvature = cells_per_turn;
  return result;
}

Survey survey(const formats::Part& part) {
  // Faces are meshed even if the part has no shells yet, because users look up their numbers here.
  formats::Part surveyed = part;
  if (surveyed.shells.empty() && surveyed.solids.empty()) surveyed.shells.emplace_back();
  MeshBuilder builder(surveyed);
  builder.describes_faces = true;
  add_patches(builder);
  add_points(builder);
  add_mesh_file(builder);
  builder.used.assign(builder.cells.position.size(), 1);
  const std::vector<int> signs = outward_signs(builder.cells);
  const std::vector<NamedGroup> groups = named_groups(builder);
  Survey result;
  result.units = part.units;
  result.faces = numbered_faces(builder, signs);
  result.groups = face_groups(builder, signs, groups);
  result.text = table("entity", entity_rows(builder)) + table("group", group_rows(builder, groups)) +
                form_table(result.faces, "face", part.units) + form_table(result.groups, "group of faces", part.units);
  if (result.text.empty()) result.text = "no entities, groups or sets\n";
  result.text += fmt::format("lengths in {}; {} nodes\n", unit_of_lengths(part), builder.cells.position.size());
  result.position = std::move(builder.cells.position);
  result.deck = std::move(builder.mesh);
  return result;
}

}  // namespace tisserand::reducer

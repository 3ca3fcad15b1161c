// SPDX-License-Identifier: GPL-3.0-or-later
// Shells, solids and beams on groups: cells with properties become elements.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/mesh/coordinates.hpp"
#include "reducer/sources/lines.hpp"
#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/selection.hpp"
#include "reducer/sources/shell_layouts.hpp"

namespace tisserand::reducer {
namespace {

[[noreturn]] void refuse_order(const MeshBuilder& builder, const Cell& cell, const User& user) {
  throw Error(
      fmt::format("{}: element {} is of second order ({} nodes)", user.name, cell.id, form_of(cell.shape).nodes),
      user.where,
      builder.part.mesh.order == 2 ? "shells and beams must be of first order: write mesh: {order: 1}"
                                   : "shells and beams must be of first order: write the mesh with order 1");
}

/// Marks an entity as used; two properties for one entity are an error.
void take(MeshBuilder& builder, int entity, const User& user) {
  std::string& owner = builder.property_of_entity[entity];
  if (!owner.empty())
    throw Error(fmt::format("{}: {} already belongs to {}", user.name, name_of(builder.cells.entities[entity]), owner),
                user.where, "give every group one property");
  owner = user.name;
}

/// Entities of a group that may get a property; elements of decks already have one.
std::vector<int> entities_for(MeshBuilder& builder, const std::vector<std::string>& on, int dimension,
                              const User& user) {
  std::vector<int> result;
  for (const std::string& name : on) {
    const Selection selection = select(builder, name, dimension, user);
    if (selection.entities.empty())
      throw Error(fmt::format("{}: '{}' is a set of a deck, whose elements already have properties", user.name, name),
                  user.where, "change the properties in the deck");
    for (const int entity : selection.entities) {
      take(builder, entity, user);
      result.push_back(entity);
    }
  }
  return result;
}

template <class Make>
void for_cells(const MeshBuilder& builder, int entity, Make make) {
  const Entity& e = builder.cells.entities[entity];
  const auto& cells = builder.cells.cells[e.dimension];
  for (std::size_t c = e.first; c < e.first + e.count; ++c) make(cells[c]);
}

void add_shell(MeshBuilder& builder, const Cell& cell, const formats::ShellLayout& layout, const User& user) {
  if (form_of(cell.shape).nodes != form_of(cell.shape).corners) refuse_order(builder, cell, user);
  ShellElement shell;
  std::copy_n(cell.nodes.begin(), form_of(cell.shape).corners, shell.nodes.begin());
  shell.property = count_of(builder.mesh.shell_properties) - 1;
  shell.offset = layout.offset;
  shell.material_x = layout.x.value_or(Eigen::Vector3d::Zero());
  shell.id = static_cast<int>(cell.id);
  builder.mesh.shells.push_back(shell);
}

void add_patch_shells(MeshBuilder& builder) {
  for (const formats::ShellPatch& patch : builder.part.patches) {
    const auto entity = std::ranges::find(builder.cells.entities, patch.name, &Entity::label);
    const int row = static_cast<int>(entity - builder.cells.entities.begin());
    if (!patch.layout) continue;
    const User user{fmt::format("'{}'", patch.name), patch.where};
    take(builder, row, user);
    builder.mesh.shell_properties.push_back(shell_property(builder.part, *patch.layout, patch.name, patch.where));
    for_cells(builder, row, [&](const Cell& cell) { add_shell(builder, cell, *patch.layout, user); });
  }
}

void add_shell_groups(MeshBuilder& builder) {
  for (const formats::ShellGroup& group : builder.part.shells) {
    const User user{fmt::format("shell '{}'", group.name), group.where};
    builder.mesh.shell_properties.push_back(shell_property(builder.part, group.layout, group.name, group.where));
    for (const int entity : entities_for(builder, group.on, 2, user))
      for_cells(builder, entity, [&](const Cell& cell) { add_shell(builder, cell, group.layout, user); });
  }
}

SolidShape solid_shape(CellShape shape) {
  static const std::map<CellShape, SolidShape> shapes{{CellShape::tetrahedron4, SolidShape::tetrahedron4},
                                                      {CellShape::tetrahedron10, SolidShape::tetrahedron10},
                                                      {CellShape::hexahedron8, SolidShape::hexahedron8},
                                                      {CellShape::hexahedron20, SolidShape::hexahedron20},
                                                      {CellShape::prism6, SolidShape::prism6},
                                                      {CellShape::prism15, SolidShape::prism15}};
  return shapes.at(shape);
}

void add_solid_groups(MeshBuilder& builder) {
  for (const formats::SolidGroup& group : builder.part.solids) {
    const User user{fmt::format("solid '{}'", group.name), group.where};
    builder.mesh.solid_properties.push_back(solid_property(builder.part, group));
    const int property = count_of(builder.mesh.solid_properties) - 1;
    for (const int entity : entities_for(builder, group.on, 3, user))
      for_cells(builder, entity, [&](const Cell& cell) {
        builder.mesh.solids.push_back({solid_shape(cell.shape), cell.nodes, property, static_cast<int>(cell.id)});
      });
  }
}

/// Orientation of beams on an entity; the default depends on all lines of the entity.
Eigen::Vector3d orientation_of(const MeshBuilder& builder, const formats::BeamLine& line, int entity) {
  if (line.orientation) return *line.orientation;
  std::vector<Eigen::Vector3d> tangents;
  for_cells(builder, entity, [&](const Cell& cell) {
    tangents.push_back((builder.position(cell.nodes[1]) - builder.position(cell.nodes[0])).normalized());
  });
  return default_orientation(tangents);
}

void add_beam_groups(MeshBuilder& builder) {
  for (const formats::BeamLine& line : builder.part.beams) {
    if (line.on.empty()) continue;
    const User user{fmt::format("beam '{}'", line.name), line.where};
    builder.mesh.beam_properties.push_back({beam_data(builder.part, line), line.name});
    for (const int entity : entities_for(builder, line.on, 1, user)) {
      const Eigen::Vector3d orientation = orientation_of(builder, line, entity);
      for_cells(builder, entity, [&](const Cell& cell) {
        if (cell.shape != CellShape::line2) refuse_order(builder, cell, user);
        BeamElement beam = beam_element(
            builder, line, {cell.nodes[0], cell.nodes[1], 0.0, 1.0, static_cast<int>(cell.id)}, orientation);
        beam.released = static_cast<std::uint16_t>(line.releases.start | (line.releases.end << 6U));
        builder.mesh.beams.push_back(beam);
      });
    }
  }
}

/// Groups that part.yaml names anywhere, or ignores explicitly.
std::set<std::string> named_groups(const formats::Part& part) {
  std::set<std::string> names(part.mesh.ignore.begin(), part.mesh.ignore.end());
  const auto add = [&names](const std::vector<std::string>& more) { names.insert(more.begin(), more.end()); };
  for (const formats::GroupDefinition& group : part.groups) add(group.groups);
  for (const formats::ShellGroup& shell : part.shells) add(shell.on);
  for (const formats::SolidGroup& solid : part.solids) add(solid.on);
  for (const formats::BeamLine& beam : part.beams) add(beam.on);
  for (const formats::SpiderLine& spider : part.spiders) add(spider.on);
  for (const formats::MeshFile::LocalSize& local : part.mesh.sizes) names.insert(local.group);
  for (const formats::NamedPoint& point : part.points)
    if (point.place) names.insert(point.place->name);
  for (const formats::BoundaryNode& node : part.boundary) names.insert(node.at.name);
  for (const formats::Support& support : part.supports) add(support.on);
  for (const formats::PartLoadCase& load : part.load_cases) {
    for (const formats::PressureLoad& pressure : load.pressures) names.insert(pressure.on);
    for (const formats::LineLoad& line : load.line_loads) names.insert(line.on);
  }
  return names;
}

/// Whether all nodes of an entity's cells already belong to elements, as on the skin of a solid or the edge of a shell.
bool lies_on_elements(const MeshBuilder& builder, int entity) {
  bool covered = true;
  for_cells(builder, entity, [&](const Cell& cell) {
    for (int k = 0; k < form_of(cell.shape).nodes; ++k)
      if (builder.used[cell.nodes[k]] == 0) covered = false;
  });
  return covered;
}

/// Throws Error for a physical group that nothing mentions and whose cells have no elements: a forgotten property.
void check_groups_have_properties(const MeshBuilder& builder) {
  const std::set<std::string> named = named_groups(builder.part);
  std::vector<Error> errors;
  for (const EntityGroup& group : builder.cells.groups) {
    if (named.contains(group.name) || group.dimension == 0) continue;
    std::size_t forgotten = 0;
    for (const int entity : group.entities)
      if (builder.property_of_entity[entity].empty() && !lies_on_elements(builder, entity))
        forgotten += builder.cells.entities[entity].count;
    if (forgotten == 0) continue;
    constexpr std::array<const char*, 4> lists{"", "beams", "shells", "solids"};
    errors.emplace_back(fmt::format("group '{}' has {} elements without a property", group.name, forgotten),
                        builder.part.mesh.file,
                        fmt::format("give it one under {} (on: {}), or ignore it with mesh: {{ignore: [{}]}}",
                                    lists[group.dimension], group.name, group.name));
  }
  if (!errors.empty()) throw merge_errors(errors);
}

/// Throws Error for patches without a layout that no shell uses, and for volumes of a geometry that no solid uses.
void check_nothing_is_left(const MeshBuilder& builder) {
  std::vector<Error> errors;
  const std::set<std::string> ignored(builder.part.mesh.ignore.begin(), builder.part.mesh.ignore.end());
  for (std::size_t e = 0; e < builder.cells.entities.size(); ++e) {
    const Entity& entity = builder.cells.entities[e];
    if (!builder.property_of_entity[e].empty() || entity.count == 0) continue;
    const auto patch = std::ranges::find(builder.part.patches, entity.label, &formats::ShellPatch::name);
    if (entity.dimension == 2 && entity.number == 0 && patch != builder.part.patches.end())
      errors.emplace_back(
          fmt::format("'{}' has no thickness and material", patch->name), patch->where,
          fmt::format("give them there, or define a shell on it (shells: {{skin: {{on: {}, ...}}}})", patch->name));
    if (entity.dimension == 3 && builder.cells.groups.empty() &&
        !ignored.contains(fmt::format("volume {}", entity.number)))
      errors.emplace_back(
          fmt::format("{} has no material", name_of(entity)), builder.part.mesh.file,
          fmt::format("give it one under solids (on: volume {}), or ignore it with mesh: {{ignore: [volume {}]}}",
                      entity.number, entity.number));
  }
  if (!errors.empty()) throw merge_errors(errors);
}

}  // namespace

void mark_used_nodes(MeshBuilder& builder) {
  const Mesh& mesh = builder.mesh;
  builder.used.assign(builder.cells.position.size(), 0);
  for (int e = 0; e < mesh.elements(); ++e)
    for (const int node : element_nodes(mesh, e)) builder.used[node] = 1;
}

void add_group_elements(MeshBuilder& builder) {
  builder.property_of_entity.assign(builder.cells.entities.size(), "");
  add_patch_shells(builder);
  add_shell_groups(builder);
  add_solid_groups(builder);
  add_beam_groups(builder);
  mark_used_nodes(builder);
  check_groups_have_properties(builder);
  check_nothing_is_left(builder);
}

}  // namespace tisserand::reducer

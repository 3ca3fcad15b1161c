// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh file of a part: cells of a geometry or mesh, or the elements of a deck, after the part file's own nodes.
#include <algorithm>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/mesh/mesh_file.hpp"
#include "reducer/mesher/import.hpp"
#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/node_references.hpp"
#include "reducer/sources/selection.hpp"

namespace tisserand::reducer {
namespace {

/// Highest dimension in which the part file needs the geometry meshed.
int wanted_dimension(const formats::Part& part) {
  if (!part.solids.empty()) return 3;
  if (!part.shells.empty()) return 2;
  return 1;
}

void append_cells(MeshBuilder& builder, const CellMesh& file) {
  CellMesh& all = builder.cells;
  const int shift = count_of(all.position);
  const int entity_shift = count_of(all.entities);
  builder.first_file_node = shift;
  all.position.insert(all.position.end(), file.position.begin(), file.position.end());
  all.node_id.insert(all.node_id.end(), file.node_id.begin(), file.node_id.end());
  for (int n = 0; n < std::ssize(file.position); ++n) {
    builder.node_of_id[file.node_id[n]] = shift + n;
    builder.label.push_back(fmt::format("node {}", file.node_id[n]));
  }
  std::array<std::size_t, 4> first{};
  for (std::size_t d = 0; d < 4; ++d) {
    first[d] = all.cells[d].size();
    all.cells[d].reserve(first[d] + file.cells[d].size());
    for (Cell cell : file.cells[d]) {
      for (int k = 0; k < form_of(cell.shape).nodes; ++k) cell.nodes[k] += shift;
      all.cells[d].push_back(cell);
    }
  }
  for (Entity entity : file.entities) {
    entity.first += first[entity.dimension];
    all.entities.push_back(entity);
  }
  if (!file.geometry.empty()) {
    all.geometry.resize(static_cast<std::size_t>(entity_shift));  // entities of the part file have no geometry
    all.geometry.insert(all.geometry.end(), file.geometry.begin(), file.geometry.end());
  }
  for (EntityGroup group : file.groups) {
    for (int& entity : group.entities) entity += entity_shift;
    all.groups.push_back(std::move(group));
  }
  builder.last_file_node = count_of(all.position);
  builder.mesh.warnings.insert(builder.mesh.warnings.end(), file.warnings.begin(), file.warnings.end());
}

/// Entities with sizes of their own. Groups have sizes, and a coarse first mesh shows their entities.
std::vector<SizedEntity> sized_entities(const MeshBuilder& builder, const ImportRequest& request) {
  const formats::MeshFile& settings = builder.part.mesh;
  std::vector<SizedEntity> sizes;
  if (settings.sizes.empty()) return sizes;
  MeshBuilder coarse(builder.part);
  append_cells(coarse, import_with_gmsh({request.settings, request.units, std::min(request.dimension, 2), {}}));
  coarse.used.assign(coarse.cells.position.size(), 1);
  for (const formats::MeshFile::LocalSize& local : settings.sizes) {
    const User user{"mesh: sizes", local.where};
    for (const int e : select(coarse, local.group, -1, user).entities) {
      const Entity& entity = coarse.cells.entities[e];
      sizes.push_back({entity.dimension, entity.number, local.size});
    }
  }
  // The smallest size is set last, because points between two faces get the last one.
  std::ranges::sort(sizes, [](const SizedEntity& a, const SizedEntity& b) { return a.size > b.size; });
  return sizes;
}

void refuse_settings(const formats::Part& part, const char* kind) {
  const formats::MeshFile& mesh = part.mesh;
  const char* key = mesh.size > 0.0          ? "size"
                    : mesh.smallest > 0.0    ? "smallest"
                    : mesh.curvature > 0     ? "curvature"
                    : !mesh.sizes.empty()    ? "sizes"
                    : mesh.order > 0         ? "order"
                    : mesh.cells.has_value() ? "cells"
                                             : nullptr;
  if (key != nullptr)
    throw Error(fmt::format("mesh: '{}' has no effect on {}, which is already meshed", key, kind), mesh.where,
                "remove it, or give the geometry (.geo, .step, .iges, .brep)");
}

template <class T>
void append(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// Shifts nodes and properties of a deck past the existing ones.
void shift_deck(Mesh& deck, int nodes, const Mesh& before) {
  for_nodes(deck, [nodes](int& node) { node += nodes; });
  const auto shift = [](auto& elements, const auto& properties) {
    for (auto& e : elements) e.property += count_of(properties);
  };
  shift(deck.beams, before.beam_properties);
  shift(deck.shells, before.shell_properties);
  shift(deck.solids, before.solid_properties);
}

/// Appends the deck's nodes, elements, sets and boundary.
void append_deck(MeshBuilder& builder, Deck& deck) {
  const int shift = count_of(builder.cells.position);
  builder.first_file_node = shift;
  for (int n = 0; n < deck.mesh.nodes(); ++n)
    builder.add_node(deck.mesh.position.col(n), std::move(deck.mesh.node_label[n]));
  builder.last_file_node = count_of(builder.cells.position);
  builder.file_is_deck = true;
  for (const auto& [id, node] : deck.node_of_id) builder.node_of_id[id] = node + shift;
  for (auto& [name, nodes] : deck.node_sets)
    for (int& node : nodes) node += shift;
  builder.node_sets = std::move(deck.node_sets);
  builder.element_sets = std::move(deck.element_sets);  // the deck's elements are the first of the mesh
  Mesh& mesh = builder.mesh;
  shift_deck(deck.mesh, shift, mesh);
  append(mesh.beam_properties, deck.mesh.beam_properties);
  append(mesh.beams, deck.mesh.beams);
  append(mesh.shell_properties, deck.mesh.shell_properties);
  append(mesh.shells, deck.mesh.shells);
  append(mesh.solid_properties, deck.mesh.solid_properties);
  append(mesh.solids, deck.mesh.solids);
  append(mesh.springs, deck.mesh.springs);
  append(mesh.masses, deck.mesh.masses);
  append(mesh.spiders, deck.mesh.spiders);
  append(mesh.equations, deck.mesh.equations);
  append(mesh.boundary, deck.mesh.boundary);
  append(mesh.warnings, deck.mesh.warnings);
}

void add_deck(MeshBuilder& builder, MeshFileKind kind) {
  const formats::MeshFile& settings = builder.part.mesh;
  refuse_settings(builder.part, "a deck");
  if (settings.scale != 1.0)
    throw Error("mesh: 'scale' has no effect on a deck, whose properties and materials are in its own units",
                settings.where, "give the units of the deck under units");
  const DeckOptions options{
      settings.unknown == formats::UnknownContent::ignore ? UnknownCards::ignore : UnknownCards::refuse,
      builder.part.boundary.empty()};
  Deck deck =
      kind == MeshFileKind::nastran ? read_nastran(settings.file, options) : read_abaqus(settings.file, options);
  if (deck.mesh.elements() == 0 && deck.mesh.masses.empty())
    throw Error("the deck has no elements", settings.file,
                "give a complete deck with nodes, elements and their properties; is the file truncated?");
  append_deck(builder, deck);
}

}  // namespace

void add_mesh_file(MeshBuilder& builder) {
  const formats::Part& part = builder.part;
  if (part.mesh.file.empty()) return;
  check_mesh_file(part.mesh.file, part.mesh.where);
  const MeshFileKind kind = mesh_file_kind(part.mesh.file, part.mesh.where);
  if (kind == MeshFileKind::nastran || kind == MeshFileKind::abaqus) return add_deck(builder, kind);
  if (kind == MeshFileKind::msh) refuse_settings(part, "a .msh file");
  ImportRequest request{part.mesh, part.units, wanted_dimension(part), {}, builder.describes_faces};
  request.sizes = sized_entities(builder, request);
  append_cells(builder, import_with_gmsh(request));
}

}  // namespace tisserand::reducer

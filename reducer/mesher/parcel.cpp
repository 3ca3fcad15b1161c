// SPDX-License-Identifier: GPL-3.0-or-later
// Packing and unpacking between two processes of one machine.
#include "reducer/mesher/parcel.hpp"

#include <cmath>

#include "common/confined/packing.hpp"

namespace tisserand::reducer {
namespace {

enum class AnswerKind : std::uint8_t { mesh = 1, error = 2 };

constexpr const char* no_mesh = "gmsh returned an invalid mesh";

void pack_cells(Packer& to, const std::vector<Cell>& cells) {
  std::vector<std::uint8_t> shapes;
  std::vector<long> ids;
  std::vector<int> nodes;
  for (const Cell& cell : cells) {
    shapes.push_back(static_cast<std::uint8_t>(cell.shape));
    ids.push_back(cell.id);
    nodes.insert(nodes.end(), nodes_of(cell).begin(), nodes_of(cell).end());
  }
  to.row(shapes);
  to.row(ids);
  to.row(nodes);
}

std::vector<Cell> unpack_cells(Unpacker& from, int dimension, std::size_t node_count) {
  const auto shapes = from.row<std::uint8_t>();
  const auto ids = from.row<long>();
  const auto nodes = from.row<int>();
  from.require(ids.size() == shapes.size(), "elements without numbers");
  std::vector<Cell> cells(shapes.size());
  std::size_t next = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    from.require(shapes[c] <= static_cast<std::uint8_t>(CellShape::prism15), "an element of unknown kind");
    cells[c].shape = static_cast<CellShape>(shapes[c]);
    cells[c].id = ids[c];
    cells[c].nodes.fill(-1);
    const CellForm form = form_of(cells[c].shape);
    from.require(form.dimension == dimension, "an element of wrong dimension");
    from.require(nodes.size() - next >= static_cast<std::size_t>(form.nodes), "an element without nodes");
    for (int k = 0; k < form.nodes; ++k) {
      const int node = nodes[next++];
      from.require(node >= 0 && static_cast<std::size_t>(node) < node_count,
                   "an element on a node that does not exist");
      cells[c].nodes[k] = node;
    }
  }
  from.require(next == nodes.size(), "nodes without an element");
  return cells;
}

void pack_vectors(Packer& to, const std::vector<Eigen::Vector3d>& vectors) {
  to.value(3 * vectors.size());
  for (const Eigen::Vector3d& vector : vectors)
    for (const double value : vector) to.value(value);
}

std::vector<Eigen::Vector3d> unpack_vectors(Unpacker& from) {
  const auto numbers = from.row<double>();
  from.require(numbers.size() % 3 == 0, "nodes without coordinates");
  std::vector<Eigen::Vector3d> vectors(numbers.size() / 3);
  for (std::size_t n = 0; n < vectors.size(); ++n) {
    vectors[n] = Eigen::Vector3d(numbers[3 * n], numbers[3 * n + 1], numbers[3 * n + 2]);
    from.require(vectors[n].allFinite(), "a coordinate that is not a finite number");
  }
  return vectors;
}

void unpack_nodes(Unpacker& from, CellMesh& mesh) {
  mesh.position = unpack_vectors(from);
  mesh.node_id = from.row<long>();
  from.require(mesh.position.size() == mesh.node_id.size(), "nodes without coordinates");
}

void pack_geometry(Packer& to, const std::vector<EntityGeometry>& geometry) {
  to.value(geometry.size());
  for (const EntityGeometry& entity : geometry) {
    to.value(entity.size);
    for (const double value : entity.center) to.value(value);
    pack_vectors(to, entity.point);
    pack_vectors(to, entity.normal);
    to.row(entity.volumes);
  }
}

void unpack_geometry(Unpacker& from, CellMesh& mesh) {
  mesh.geometry.resize(from.size(4 * sizeof(double)));
  from.require(mesh.geometry.empty() || mesh.geometry.size() == mesh.entities.size(), "geometry without an entity");
  for (EntityGeometry& entity : mesh.geometry) {
    entity.size = from.value<double>();
    for (double& value : entity.center) value = from.value<double>();
    from.require(std::isfinite(entity.size) && entity.size >= 0.0 && entity.center.allFinite(),
                 "a size that is not a finite number");
    entity.point = unpack_vectors(from);
    entity.normal = unpack_vectors(from);
    from.require(entity.point.size() == entity.normal.size(), "points of a face without normals");
    entity.volumes = from.row<int>();
  }
}

void unpack_entities(Unpacker& from, CellMesh& mesh) {
  std::array<std::size_t, 4> next{};  // cells of a dimension belong to its entities in sequence
  mesh.entities.resize(from.size(4 * sizeof(int)));
  for (Entity& entity : mesh.entities) {
    entity.dimension = from.value<int>();
    entity.number = from.value<int>();
    entity.label = from.text();
    entity.first = from.value<std::size_t>();
    entity.count = from.value<std::size_t>();
    from.require(entity.dimension >= 1 && entity.dimension <= 3, "an entity of unknown dimension");
    std::size_t& first = next[entity.dimension];
    from.require(entity.first == first && entity.count <= mesh.cells[entity.dimension].size() - first,
                 "an entity with elements that do not exist");
    first += entity.count;
  }
  for (int d = 1; d <= 3; ++d) from.require(next[d] == mesh.cells[d].size(), "elements without an entity");
}

void unpack_groups(Unpacker& from, CellMesh& mesh) {
  mesh.groups.resize(from.size(2 * sizeof(int)));
  for (EntityGroup& group : mesh.groups) {
    group.name = from.text();
    group.dimension = from.value<int>();
    group.entities = from.row<int>();
    from.require(group.dimension >= 1 && group.dimension <= 3, "a group of unknown dimension");
    for (const int row : group.entities)
      from.require(row >= 0 && static_cast<std::size_t>(row) < mesh.entities.size() &&
                       mesh.entities[row].dimension == group.dimension,
                   "a group with entities that do not exist");
  }
}

}  // namespace

std::string pack(const GeometryRequest& r) {
  Packer to;
  to.text(r.file);
  to.value(static_cast<int>(r.kind));
  to.text(r.target_unit);
  for (const int value : {r.dimension, r.curvature, r.order}) to.value(value);
  for (const double value : {r.size, r.smallest, r.scale, r.seconds, r.bytes}) to.value(value);
  for (const bool value : {r.quadrilaterals, r.describes_faces, r.is_program, r.is_trusted})
    to.value(static_cast<std::uint8_t>(value));
  to.value(r.sizes.size());
  for (const SizedEntity& sized : r.sizes) {
    to.value(sized.dimension);
    to.value(sized.number);
    to.value(sized.size);
  }
  return to.bytes;
}

GeometryRequest unpack_request(const std::string& bytes) {
  GeometryRequest r;
  const std::string nowhere;
  Unpacker from(bytes, nowhere, no_mesh);
  r.file = from.raw_text();
  r.kind = static_cast<MeshFileKind>(from.value<int>());
  r.target_unit = from.raw_text();
  for (int* value : {&r.dimension, &r.curvature, &r.order}) *value = from.value<int>();
  for (double* value : {&r.size, &r.smallest, &r.scale, &r.seconds, &r.bytes}) *value = from.value<double>();
  for (bool* value : {&r.quadrilaterals, &r.describes_faces, &r.is_program, &r.is_trusted}) *value = from.flag();
  r.sizes.resize(from.size(sizeof(double)));
  for (SizedEntity& sized : r.sizes) {
    sized.dimension = from.value<int>();
    sized.number = from.value<int>();
    sized.size = from.value<double>();
  }
  from.end();
  return r;
}

std::string pack(const CellMesh& mesh) {
  Packer to;
  to.value(AnswerKind::mesh);
  pack_vectors(to, mesh.position);
  to.row(mesh.node_id);
  for (int d = 1; d <= 3; ++d) pack_cells(to, mesh.cells[d]);
  to.value(mesh.entities.size());
  for (const Entity& entity : mesh.entities) {
    to.value(entity.dimension);
    to.value(entity.number);
    to.text(entity.label);
    to.value(entity.first);
    to.value(entity.count);
  }
  to.value(mesh.groups.size());
  for (const EntityGroup& group : mesh.groups) {
    to.text(group.name);
    to.value(group.dimension);
    to.row(group.entities);
  }
  pack_geometry(to, mesh.geometry);
  to.value(mesh.warnings.size());
  for (const std::string& warning : mesh.warnings) to.text(warning);
  return to.bytes;
}

std::string pack(const Error& error) {
  Packer to;
  to.value(AnswerKind::error);
  to.error(error);
  return to.bytes;
}

CellMesh unpack_answer(const std::string& bytes, const std::string& file) {
  Unpacker from(bytes, file, no_mesh);
  const auto kind = from.value<std::uint8_t>();
  if (kind == static_cast<std::uint8_t>(AnswerKind::error)) throw from.error();
  from.require(kind == static_cast<std::uint8_t>(AnswerKind::mesh), "its kind is unknown");
  CellMesh mesh;
  unpack_nodes(from, mesh);
  for (int d = 1; d <= 3; ++d) mesh.cells[d] = unpack_cells(from, d, mesh.position.size());
  unpack_entities(from, mesh);
  unpack_groups(from, mesh);
  unpack_geometry(from, mesh);
  mesh.warnings.resize(from.size(sizeof(std::size_t)));
  for (std::string& warning : mesh.warnings) warning = from.text();
  from.end();
  return mesh;
}

std::string doing(MesherPhase phase) {
  switch (phase) {
    case MesherPhase::starting:
      return "starting";
    case MesherPhase::reading:
      return "reading the file";
    case MesherPhase::meshing:
      return "meshing the geometry";
    case MesherPhase::answering:
      return "returning the mesh";
  }
  return "reading the file";  // a separate byte
}

}  // namespace tisserand::reducer

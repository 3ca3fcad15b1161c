// Elements to discrete entities of gmsh, one for each property.
#include "reducer/gmsh/write.hpp"

#include <array>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "common/text.hpp"
#include "reducer/gmsh/session.hpp"

namespace tisserand::reducer {
namespace {

/// Nodes of the elements of one gmsh type and property, one after the other.
struct Batch {
  int dimension = 1;
  std::string name;
  std::map<int, std::vector<std::size_t>> nodes;  ///< by gmsh's element type
};

std::size_t tag(int node) { return static_cast<std::size_t>(node) + 1; }

constexpr int point_type = 15, line_type = 1, triangle_type = 2, quadrilateral_type = 3;

int gmsh_type(SolidShape shape) {
  constexpr std::array types{4, 11, 5, 17, 6, 18};
  return types[static_cast<int>(shape)];
}

template <class Property>
std::vector<Batch> batches_of(const std::vector<Property>& properties, int dimension) {
  std::vector<Batch> batches;
  for (const Property& property : properties) batches.push_back({dimension, property.name, {}});
  return batches;
}

std::vector<Batch> element_batches(const Mesh& mesh) {
  std::vector<Batch> all = batches_of(mesh.beam_properties, 1);
  for (const BeamElement& e : mesh.beams) {
    auto& nodes = all[e.property].nodes[line_type];
    nodes.insert(nodes.end(), {tag(e.first), tag(e.second)});
  }
  std::vector<Batch> shells = batches_of(mesh.shell_properties, 2), solids = batches_of(mesh.solid_properties, 3);
  for (const ShellElement& e : mesh.shells) {
    auto& nodes = shells[e.property].nodes[e.corners() == 3 ? triangle_type : quadrilateral_type];
    for (int k = 0; k < e.corners(); ++k) nodes.push_back(tag(e.nodes[k]));
  }
  for (const SolidElement& e : mesh.solids) {
    auto& nodes = solids[e.property].nodes[gmsh_type(e.shape)];
    for (int k = 0; k < node_count(e.shape); ++k) nodes.push_back(tag(e.nodes[k]));
  }
  all.insert(all.end(), shells.begin(), shells.end());
  all.insert(all.end(), solids.begin(), solids.end());
  return all;
}

void add_connections(const Mesh& mesh, std::vector<Batch>& batches) {
  for (const Spring& s : mesh.springs) batches.push_back({1, s.name, {{line_type, {tag(s.first), tag(s.second)}}}});
  for (const Spider& s : mesh.spiders) {
    Batch batch{1, s.name, {}};
    for (const int node : s.nodes)
      batch.nodes[line_type].insert(batch.nodes[line_type].end(), {tag(s.reference), tag(node)});
    batches.push_back(batch);
  }
  for (const MeshBoundary& b : mesh.boundary) batches.push_back({0, b.name, {{point_type, {tag(b.node)}}}});
  for (const NodalMass& m : mesh.masses) batches.push_back({0, m.name, {{point_type, {tag(m.node)}}}});
}

/// Batches of the same name and dimension become one physical group.
void add_entities(const Mesh& mesh, const std::vector<Batch>& batches) {
  std::vector<std::size_t> tags(static_cast<std::size_t>(mesh.nodes()));
  for (int n = 0; n < mesh.nodes(); ++n) tags[n] = tag(n);
  const std::vector<double> coordinates(mesh.position.data(), mesh.position.data() + mesh.position.size());
  bool first = true;
  std::map<std::pair<int, std::string>, std::vector<int>> groups;
  for (const Batch& batch : batches) {
    if (batch.nodes.empty()) continue;
    const int entity = gmsh::model::addDiscreteEntity(batch.dimension);
    if (first) gmsh::model::mesh::addNodes(batch.dimension, entity, tags, coordinates);
    first = false;
    for (const auto& [type, nodes] : batch.nodes) gmsh::model::mesh::addElementsByType(entity, type, {}, nodes);
    groups[{batch.dimension, batch.name}].push_back(entity);
  }
  for (const auto& [name, entities] : groups)
    gmsh::model::setPhysicalName(name.first, gmsh::model::addPhysicalGroup(name.first, entities), name.second);
}

}  // namespace

void write_gmsh_file(const Mesh& mesh, const std::string& path) {
  with_gmsh(path, "", [&] {
    const GmshSession session;
    gmsh::model::add("mesh");
    std::vector<Batch> batches = element_batches(mesh);
    add_connections(mesh, batches);
    add_entities(mesh, batches);
    const std::string temporary = temporary_beside(path) + ".msh";
    gmsh::write(temporary);
    publish_file(temporary, path);
  });
}

}  // namespace tisserand::reducer

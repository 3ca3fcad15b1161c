// SPDX-License-Identifier: GPL-3.0-or-later
// Elements as discrete entities of a .msh file, one for each property (gmsh's documentation, "MSH file format").
#include "reducer/mesh/gmsh_file.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "common/program/version.hpp"
#include "common/stable_sort.hpp"
#include "common/text.hpp"
#include "reducer/mesh/solid_faces.hpp"

namespace tisserand::reducer {
namespace {

/// Nodes of the elements of one gmsh type and property, in sequence.
struct Batch {
  int dimension = 1;
  std::string name;
  std::map<int, std::vector<int>> nodes;  ///< key: gmsh's element type
};

void append(std::vector<int>& to, const auto& nodes) { to.insert(to.end(), nodes.begin(), nodes.end()); }

/// Entity of the file: a batch that is not empty.
struct MshEntity {
  const Batch* batch;
  int number;  ///< from 1 in its dimension
  int group;   ///< number of its physical group
};

constexpr int point_type = 15, line_type = 1, triangle_type = 2, quadrilateral_type = 3;

int nodes_of_type(int type) { return type == point_type ? 1 : form_of(*cell_shape(type)).nodes; }

template <class Property>
std::vector<Batch> batches_of(const std::vector<Property>& properties, int dimension) {
  std::vector<Batch> batches;
  for (const Property& property : properties) batches.push_back({dimension, property.name, {}});
  return batches;
}

std::vector<Batch> element_batches(const Mesh& mesh) {
  std::vector<Batch> all = batches_of(mesh.beam_properties, 1);
  for (const BeamElement& e : mesh.beams) append(all[e.property].nodes[line_type], nodes_of(e));
  std::vector<Batch> shells = batches_of(mesh.shell_properties, 2), solids = batches_of(mesh.solid_properties, 3);
  for (const ShellElement& e : mesh.shells)
    append(shells[e.property].nodes[e.corners() == 3 ? triangle_type : quadrilateral_type], nodes_of(e));
  for (const SolidElement& e : mesh.solids)
    append(solids[e.property].nodes[form_of(as_cell(e).shape).gmsh_type], nodes_of(e));
  all.insert(all.end(), shells.begin(), shells.end());
  all.insert(all.end(), solids.begin(), solids.end());
  return all;
}

void add_connections(const Mesh& mesh, std::vector<Batch>& batches) {
  for (const Spring& s : mesh.springs) batches.push_back({1, s.name, {{line_type, {s.first, s.second}}}});
  for (const Spider& s : mesh.spiders) {
    Batch batch{1, s.name, {}};
    for (const int node : s.nodes) batch.nodes[line_type].insert(batch.nodes[line_type].end(), {s.reference, node});
    batches.push_back(batch);
  }
  for (const MeshBoundary& b : mesh.boundary) batches.push_back({0, b.name, {{point_type, {b.node}}}});
  for (const NodalMass& m : mesh.masses) batches.push_back({0, m.name, {{point_type, {m.node}}}});
}

using Groups = std::map<std::pair<int, std::string>, int>;  // key: dimension and name, value: number

/// Entities of the batches; batches of the same name and dimension become one physical group.
std::vector<MshEntity> entities_of(const std::vector<Batch>& batches, Groups& groups) {
  std::vector<MshEntity> entities;
  std::array<int, 4> count{};
  for (const Batch& batch : batches) {
    if (batch.nodes.empty()) continue;
    const int next = count_of(groups) + 1;
    const int group = groups.emplace(std::pair{batch.dimension, batch.name}, next).first->second;
    entities.push_back({&batch, ++count[batch.dimension], group});
  }
  sort_stably(entities, {}, [](const MshEntity& e) { return e.batch->dimension; });
  return entities;
}

class MshText {
 public:
  template <class... Values>
  void line(fmt::format_string<Values...> form, Values&&... values) {
    fmt::format_to(std::back_inserter(text), form, std::forward<Values>(values)...);
    text += '\n';
  }
  std::string text;
};

void write_entities(MshText& out, const Mesh& mesh, const std::vector<MshEntity>& entities) {
  std::array<int, 4> count{};
  for (const MshEntity& e : entities) ++count[e.batch->dimension];
  out.line("$Entities\n{} {} {} {}", count[0], count[1], count[2], count[3]);
  for (const MshEntity& e : entities) {
    const int some = e.batch->nodes.begin()->second.front();
    Eigen::Vector3d low = mesh.position.col(some), high = low;
    for (const auto& [type, nodes] : e.batch->nodes)
      for (const int node : nodes) {
        low = low.cwiseMin(mesh.position.col(node));
        high = high.cwiseMax(mesh.position.col(node));
      }
    if (e.batch->dimension == 0)
      out.line("{} {} {} {} 1 {}", e.number, low[0], low[1], low[2], e.group);
    else
      out.line("{} {} {} {} {} {} {} 1 {} 0", e.number, low[0], low[1], low[2], high[0], high[1], high[2], e.group);
  }
  out.line("$EndEntities");
}

/// Writes all nodes as nodes of the first entity, which has elements if there are any.
void write_nodes(MshText& out, const Mesh& mesh, const MshEntity& owner) {
  const int n = mesh.nodes();
  out.line("$Nodes\n1 {} 1 {}\n{} {} 0 {}", n, n, owner.batch->dimension, owner.number, n);
  for (int k = 1; k <= n; ++k) out.line("{}", k);
  for (int k = 0; k < n; ++k) out.line("{} {} {}", mesh.position(0, k), mesh.position(1, k), mesh.position(2, k));
  out.line("$EndNodes");
}

void write_elements(MshText& out, const std::vector<MshEntity>& entities) {
  std::size_t blocks = 0, elements = 0;
  for (const MshEntity& e : entities)
    for (const auto& [type, nodes] : e.batch->nodes) {
      ++blocks;
      elements += nodes.size() / static_cast<std::size_t>(nodes_of_type(type));
    }
  out.line("$Elements\n{} {} 1 {}", blocks, elements, elements);
  std::size_t number = 0;
  for (const MshEntity& e : entities)
    for (const auto& [type, nodes] : e.batch->nodes) {
      const auto per_element = static_cast<std::size_t>(nodes_of_type(type));
      out.line("{} {} {} {}", e.batch->dimension, e.number, type, nodes.size() / per_element);
      for (std::size_t first = 0; first < nodes.size(); first += per_element) {
        fmt::format_to(std::back_inserter(out.text), "{}", ++number);
        for (std::size_t k = first; k < first + per_element; ++k)
          fmt::format_to(std::back_inserter(out.text), " {}", nodes[k] + 1);
        out.text += '\n';
      }
    }
  out.line("$EndElements");
}

}  // namespace

void write_gmsh_file(const Mesh& mesh, const std::string& path) {
  std::vector<Batch> batches = element_batches(mesh);
  add_connections(mesh, batches);
  Groups groups;
  const std::vector<MshEntity> entities = entities_of(batches, groups);
  MshText out;
  out.line("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\n{}\n$EndComments\n$PhysicalNames\n{}", producer("reducer"),
           groups.size());
  for (const auto& [group, number] : groups) {
    std::string name = group.second;
    std::ranges::replace(name, '"', '\'');
    out.line("{} {} \"{}\"", group.first, number, name);
  }
  out.line("$EndPhysicalNames");
  write_entities(out, mesh, entities);
  if (!entities.empty()) write_nodes(out, mesh, entities.back());
  write_elements(out, entities);
  write_text_file(path, out.text);
}

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Parts as unions of nodes by elements, groups as unions of parts by joints, loops as unions of joints by cycles.
#include "mechanism/model/connected_bodies.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "mechanism/model/bodies.hpp"
#include "mechanism/model/element_map.hpp"
#include "mechanism/model/forces.hpp"

namespace tisserand::mechanism {
namespace {

/// Disjoint sets of 0 ... count − 1.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = std::exchange(parent_[i], parent_[parent_[i]]);
    return i;
  }
  void unite(std::size_t i, std::size_t j) { parent_[find(j)] = find(i); }

 private:
  std::vector<std::size_t> parent_;
};

struct NodeFacts {
  Sets sets;
  std::vector<std::string> name;  ///< name of the body
  std::vector<double> mass;       ///< mass of the bodies whose first node it is
};

template <class Nodes>
void add_body(const Nodes& nodes, const std::string& name, double mass, NodeFacts& facts) {
  const auto first = static_cast<std::size_t>(nodes.front());
  for (const int node : nodes) {
    facts.sets.unite(first, static_cast<std::size_t>(node));
    facts.name[node] = name;
  }
  facts.mass[first] += mass;
}

/// Graph whose vertices are the nodes, the ground and the couplings. A joint is an edge between two nodes. A term of a
/// coupling is two edges, from the coupling to the two nodes of its coordinate.
struct JointGraph {
  struct Edge {
    std::size_t a, b;
  };
  std::vector<Edge> edges;                         ///< of joints, then of couplings in their order
  std::vector<std::vector<std::size_t>> edges_of;  ///< per vertex: nodes, ground, couplings
};

JointGraph graph_of(const Model& model) {
  const std::size_t ground = model.nodes.size();
  const auto vertex = [&](const Marker& marker) {
    if (marker.node < 0) return ground;
    const int modal = model.nodes[marker.node].modal;
    return static_cast<std::size_t>(modal < 0 ? marker.node : modal_body_of(model, modal).node);
  };
  JointGraph graph{{}, std::vector<std::vector<std::size_t>>(ground + 1 + model.couplings.size())};
  const auto add = [&](std::size_t a, std::size_t b) {
    graph.edges_of[a].push_back(graph.edges.size());
    graph.edges_of[b].push_back(graph.edges.size());
    graph.edges.push_back({a, b});
  };
  for (const Joint& joint : model.joints) add(vertex(joint.a), vertex(joint.b));
  for (std::size_t i = 0; i < model.couplings.size(); ++i)
    for (const CouplingTerm& term : model.couplings[i].terms) {
      add(vertex(model.coordinates[term.coordinate].a), ground + 1 + i);
      add(vertex(model.coordinates[term.coordinate].b), ground + 1 + i);
    }
  return graph;
}

/// Unites all edges that lie on a common cycle. Each edge that is not in a spanning forest closes one cycle with edges
/// of the forest. These cycles are enough, since all others are combinations of them.
void unite_cycles(const JointGraph& graph, Sets& sets) {
  constexpr std::size_t none = -1;
  const std::size_t vertices = graph.edges_of.size();
  std::vector<std::size_t> depth(vertices, none), up(vertices, none), order;  // up: edge to the parent
  const auto other_end = [&](std::size_t edge, std::size_t v) {
    return graph.edges[edge].a == v ? graph.edges[edge].b : graph.edges[edge].a;
  };
  for (std::size_t root = 0; root < vertices; ++root) {
    if (depth[root] != none) continue;
    depth[root] = 0;
    order = {root};
    for (std::size_t at = 0; at < order.size(); ++at)
      for (const std::size_t edge : graph.edges_of[order[at]]) {
        const std::size_t next = other_end(edge, order[at]);
        if (depth[next] != none) continue;
        depth[next] = depth[order[at]] + 1;
        up[next] = edge;
        order.push_back(next);
      }
  }
  for (std::size_t edge = 0; edge < graph.edges.size(); ++edge) {
    auto [a, b] = graph.edges[edge];
    if (up[a] == edge || up[b] == edge) continue;
    for (; a != b; a = other_end(up[a], a)) {
      if (depth[a] < depth[b]) std::swap(a, b);
      sets.unite(edge, up[a]);
    }
  }
}

}  // namespace

Parts find_parts(const Model& model) {
  const std::size_t count = model.nodes.size();
  NodeFacts facts{Sets(count), std::vector<std::string>(count), std::vector<double>(count, 0.0)};
  for (std::size_t i = 0; i < count; ++i) facts.name[i] = model.nodes[i].name;
  for_each_body(model, [&](const auto& body) {
    add_body(attached_nodes(model, body), name_of(model, body), mass_of(model, body), facts);
  });

  Parts parts;
  parts.of_node.resize(count);
  std::map<std::size_t, int> part_of_root;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [at, is_new] = part_of_root.try_emplace(facts.sets.find(i), parts.count());
    if (is_new) {
      parts.name.push_back(facts.name[i]);
      parts.first_node.push_back(static_cast<int>(i));
      parts.mass.push_back(0.0);
    }
    parts.of_node[i] = at->second;
    parts.mass[at->second] += facts.mass[i];
  }
  return parts;
}

std::vector<std::vector<std::string>> connected_groups(const Model& model, const Parts& parts) {
  const auto ground = static_cast<std::size_t>(parts.count());
  Sets sets(ground + 1);
  const auto part_of = [&](const Marker& marker) {
    return marker.node < 0 ? ground : static_cast<std::size_t>(parts.of_node[marker.node]);
  };
  for (const Joint& joint : model.joints) sets.unite(part_of(joint.a), part_of(joint.b));
  for_each_force(model, [&](auto traits, const auto& force) {
    if (!traits.connects) return;
    const std::size_t first = traits.markers.size() > 1 ? part_of(force.*traits.markers.front()) : ground;
    for (const auto marker : traits.markers) sets.unite(first, part_of(force.*marker));
  });
  for (const Coordinate& c : model.coordinates)
    if (c.active) sets.unite(part_of(c.a), part_of(c.b));
  for (const Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms)
      sets.unite(part_of(model.coordinates[coupling.terms.front().coordinate].b),
                 part_of(model.coordinates[term.coordinate].b));
  std::map<std::size_t, std::vector<std::string>> groups;
  groups[sets.find(ground)].push_back("ground");
  for (std::size_t i = 0; i < ground; ++i) groups[sets.find(i)].push_back(parts.name[i]);
  std::vector<std::vector<std::string>> result;
  for (auto& [root, names] : groups) result.push_back(std::move(names));
  return result;
}

std::vector<Loop> find_loops(const Model& model) {
  const JointGraph graph = graph_of(model);
  Sets sets(graph.edges.size());
  unite_cycles(graph, sets);
  const auto unite_all_at = [&](std::size_t vertex) {
    for (const std::size_t edge : graph.edges_of[vertex]) sets.unite(graph.edges_of[vertex].front(), edge);
  };
  for (const ModalBody& body : model.modal_bodies) unite_all_at(static_cast<std::size_t>(body.node));
  for (std::size_t i = 0; i < model.couplings.size(); ++i) unite_all_at(model.nodes.size() + 1 + i);

  std::vector<Loop> loops;
  std::map<std::size_t, std::size_t> loop_of_root;
  const auto loop_at = [&](std::size_t edge, const ElementMap& map) -> Loop& {
    const auto [at, is_new] = loop_of_root.try_emplace(sets.find(edge), loops.size());
    if (is_new) loops.emplace_back();
    Loop& loop = loops[at->second];
    std::ranges::copy_if(map.coordinates, std::back_inserter(loop.coordinates), [](int c) { return c >= 0; });
    return loop;
  };
  std::size_t edge = 0;
  for (int i = 0; i < std::ssize(model.joints); ++i, ++edge) loop_at(edge, model.joints.maps[i]).joints.push_back(i);
  for (int i = 0; i < std::ssize(model.couplings); ++i) {
    loop_at(edge, model.couplings.maps[i]).couplings.push_back(i);
    edge += 2 * model.couplings[i].terms.size();
  }
  for (Loop& loop : loops) {
    std::ranges::sort(loop.coordinates);
    const auto rest = std::ranges::unique(loop.coordinates);
    loop.coordinates.erase(rest.begin(), rest.end());
  }
  return loops;
}

}  // namespace tisserand::mechanism

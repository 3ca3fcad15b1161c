// SPDX-License-Identifier: GPL-3.0-or-later
// Parts as unions of nodes by elements, and groups as unions of parts by joints.
#include "mechanism/model/connected_bodies.hpp"

#include <map>
#include <numeric>
#include <utility>

#include "mechanism/model/bodies.hpp"
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

}  // namespace tisserand::mechanism

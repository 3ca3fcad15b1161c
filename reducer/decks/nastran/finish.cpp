// SPDX-License-Identifier: GPL-3.0-or-later
// Last step of a Nastran deck: nodes by their numbers, and elements of properties as sets.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

std::vector<int> nodes_of(const Mesh& mesh, const ElementSet& set) {
  std::vector<int> nodes;
  const auto add = [&nodes](const auto& elements, const std::vector<int>& rows) {
    for (const int row : rows)
      for (const int node : nodes_of(elements[row])) nodes.push_back(node);
  };
  add(mesh.beams, set.beams);
  add(mesh.shells, set.shells);
  add(mesh.solids, set.solids);
  add(mesh.springs, set.springs);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

void finish_nodes(NastranModel& model) {
  std::vector<std::pair<long, int>> ids;
  for (int i = 0; i < std::ssize(model.grid_id); ++i) ids.emplace_back(model.grid_id[i], i);
  std::sort(ids.begin(), ids.end());
  model.deck.node_of_id = std::map<long, int>(ids.begin(), ids.end());
  for (auto& [id, set] : model.of_property) {
    const std::string name = fmt::format("pid{}", id);
    model.deck.node_sets[name] = nodes_of(model.deck.mesh, set);
    model.deck.element_sets[name] = std::move(set);
  }
}

}  // namespace tisserand::reducer

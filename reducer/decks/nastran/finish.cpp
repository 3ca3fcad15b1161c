// Last step of a Nastran deck: nodes by their numbers, and the elements of properties as sets.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

std::vector<int> nodes_of(const Mesh& mesh, const ElementSet& set) {
  std::vector<int> nodes;
  for (const int row : set.beams) {
    const BeamElement& beam = mesh.beams[row];
    nodes.insert(nodes.end(), {beam.first, beam.second});
  }
  for (const int row : set.shells) {
    const ShellElement& shell = mesh.shells[row];
    nodes.insert(nodes.end(), shell.nodes.begin(), shell.nodes.begin() + shell.corners());
  }
  for (const int row : set.solids) {
    const SolidElement& solid = mesh.solids[row];
    nodes.insert(nodes.end(), solid.nodes.begin(), solid.nodes.begin() + node_count(solid.shape));
  }
  for (const int row : set.springs) {
    const Spring& spring = mesh.springs[row];
    nodes.insert(nodes.end(), {spring.first, spring.second});
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

void finish_nodes(NastranModel& model) {
  std::vector<std::pair<long, int>> ids;
  for (std::size_t i = 0; i < model.grid_id.size(); ++i) ids.emplace_back(model.grid_id[i], static_cast<int>(i));
  std::sort(ids.begin(), ids.end());
  model.deck.node_of_id = std::map<long, int>(ids.begin(), ids.end());
  for (auto& [id, set] : model.of_property) {
    const std::string name = fmt::format("pid{}", id);
    model.deck.node_sets[name] = nodes_of(model.deck.mesh, set);
    model.deck.element_sets[name] = std::move(set);
  }
}

}  // namespace tisserand::reducer

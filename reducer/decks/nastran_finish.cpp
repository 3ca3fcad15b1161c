// Last step of a Nastran deck: nodes to which nothing is attached leave the mesh, and sets get their names.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "reducer/decks/nastran_model.hpp"

namespace tisserand::reducer {
namespace {

/// New numbers of the nodes that stay, −1 for the others.
std::vector<int> new_numbers(const NastranModel& model) {
  std::vector<Components> attached = attachments(model.deck.mesh);
  for (const MeshBoundary& node : model.deck.mesh.boundary)
    attached[static_cast<std::size_t>(node.node)] = all_components;
  std::vector<int> number(attached.size(), -1);
  int next = 0;
  for (std::size_t i = 0; i < attached.size(); ++i)
    if (attached[i] != 0) number[i] = next++;
  return number;
}

void renumber_elements(const std::vector<int>& number, Mesh& mesh) {
  const auto move = [&](int& node) { node = number[static_cast<std::size_t>(node)]; };
  for (BeamElement& beam : mesh.beams) {
    move(beam.first);
    move(beam.second);
  }
  for (ShellElement& shell : mesh.shells)
    for (int i = 0; i < shell.corners(); ++i) move(shell.nodes[static_cast<std::size_t>(i)]);
  for (SolidElement& solid : mesh.solids)
    for (int i = 0; i < node_count(solid.shape); ++i) move(solid.nodes[static_cast<std::size_t>(i)]);
  for (Spring& spring : mesh.springs) {
    move(spring.first);
    move(spring.second);
  }
}

void renumber_rest(const std::vector<int>& number, Mesh& mesh) {
  const auto move = [&](int& node) { node = number[static_cast<std::size_t>(node)]; };
  for (NodalMass& mass : mesh.masses) move(mass.node);
  for (Spider& spider : mesh.spiders) {
    move(spider.reference);
    for (int& node : spider.nodes) move(node);
  }
  for (TieEquation& equation : mesh.equations)
    for (TieTerm& term : equation.terms) move(term.node);
  for (MeshBoundary& node : mesh.boundary) move(node.node);
}

void remove_free_nodes(NastranModel& model) {
  const std::vector<int> number = new_numbers(model);
  if (std::find(number.begin(), number.end(), -1) == number.end()) return;
  Mesh& mesh = model.deck.mesh;
  renumber_elements(number, mesh);
  renumber_rest(number, mesh);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) {
      model.remarks.add("grid points without elements, masses and ties are left out", std::to_string(model.grid_id[i]));
      continue;
    }
    mesh.position.col(static_cast<Eigen::Index>(kept)) = mesh.position.col(static_cast<Eigen::Index>(i)).eval();
    mesh.node_label[kept] = std::move(mesh.node_label[i]);
    model.grid_id[kept] = model.grid_id[i];
    ++kept;
  }
  mesh.position.conservativeResize(3, static_cast<Eigen::Index>(kept));
  mesh.node_label.resize(kept);
  model.grid_id.resize(kept);
}

std::vector<int> nodes_of(const Mesh& mesh, const ElementSet& set) {
  std::vector<int> nodes;
  for (const int row : set.beams) {
    const BeamElement& beam = mesh.beams[static_cast<std::size_t>(row)];
    nodes.insert(nodes.end(), {beam.first, beam.second});
  }
  for (const int row : set.shells) {
    const ShellElement& shell = mesh.shells[static_cast<std::size_t>(row)];
    nodes.insert(nodes.end(), shell.nodes.begin(), shell.nodes.begin() + shell.corners());
  }
  for (const int row : set.solids) {
    const SolidElement& solid = mesh.solids[static_cast<std::size_t>(row)];
    nodes.insert(nodes.end(), solid.nodes.begin(), solid.nodes.begin() + node_count(solid.shape));
  }
  for (const int row : set.springs) {
    const Spring& spring = mesh.springs[static_cast<std::size_t>(row)];
    nodes.insert(nodes.end(), {spring.first, spring.second});
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

void finish_nodes(NastranModel& model) {
  remove_free_nodes(model);
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

// Nodes that nothing uses (those that only gave a direction, those of elements that were ignored) leave the deck.
#include <algorithm>

#include <fmt/format.h>

#include "common/text.hpp"
#include "reducer/decks/abaqus_mesh.hpp"

namespace tisserand::reducer::abaqus {
namespace {

/// Calls action(int& node) for every node that an element, a mass, a tie or the boundary refers to.
template <class Action>
void for_each_use(Mesh& mesh, const Action& action) {
  for (BeamElement& beam : mesh.beams) action(beam.first), action(beam.second);
  for (ShellElement& shell : mesh.shells) std::for_each_n(shell.nodes.begin(), shell.corners(), action);
  for (SolidElement& solid : mesh.solids) std::for_each_n(solid.nodes.begin(), node_count(solid.shape), action);
  for (Spring& spring : mesh.springs) action(spring.first), action(spring.second);
  for (NodalMass& mass : mesh.masses) action(mass.node);
  for (Spider& spider : mesh.spiders) {
    action(spider.reference);
    std::for_each(spider.nodes.begin(), spider.nodes.end(), action);
  }
  for (TieEquation& equation : mesh.equations)
    for (TieTerm& term : equation.terms) action(term.node);
  for (MeshBoundary& boundary : mesh.boundary) action(boundary.node);
}

void remove_from_sets(const std::vector<int>& number, Deck& deck) {
  for (auto& [name, nodes] : deck.node_sets) {
    for (int& node : nodes) node = number[static_cast<std::size_t>(node)];
    std::erase(nodes, -1);
  }
  std::erase_if(deck.node_of_id, [&](const auto& entry) { return number[static_cast<std::size_t>(entry.second)] < 0; });
  for (auto& [id, node] : deck.node_of_id) node = number[static_cast<std::size_t>(node)];
}

}  // namespace

void remove_unused_nodes(Deck& deck) {
  Mesh& mesh = deck.mesh;
  std::vector<int> number(static_cast<std::size_t>(mesh.nodes()), -1);
  for_each_use(mesh, [&](int& node) { number[static_cast<std::size_t>(node)] = 0; });
  std::vector<std::string> unused;
  long count = 0;
  int kept = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) {
      if (++count <= 5) unused.push_back(mesh.node_label[i]);
      continue;
    }
    mesh.position.col(kept) = mesh.position.col(static_cast<Eigen::Index>(i)).eval();
    if (static_cast<std::size_t>(kept) != i)
      mesh.node_label[static_cast<std::size_t>(kept)] = std::move(mesh.node_label[i]);
    number[i] = kept++;
  }
  if (count == 0) return;
  mesh.position.conservativeResize(3, kept);
  mesh.node_label.resize(static_cast<std::size_t>(kept));
  for_each_use(mesh, [&](int& node) { node = number[static_cast<std::size_t>(node)]; });
  remove_from_sets(number, deck);
  mesh.warnings.push_back(fmt::format("{} nodes without elements, masses and ties are left out: {}{}", count,
                                      join(unused, ", "), count > 5 ? ", ..." : ""));
}

}  // namespace tisserand::reducer::abaqus

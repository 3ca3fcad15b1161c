// Drawn beams that touch without a node in common: told, because a frame drawn so is not joined there.
#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/node_grid.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;
using Pairs = std::set<std::pair<int, int>>;

constexpr double touching = 1e-6;  ///< of an element's length
constexpr std::size_t most_told = 10;

/// Pairs of nodes that a spring or a spider ties: they may lie at one place on purpose.
Pairs tied_pairs(const Mesh& mesh) {
  Pairs pairs;
  for (const Spring& spring : mesh.springs) pairs.insert(std::minmax(spring.first, spring.second));
  for (const Spider& spider : mesh.spiders)
    for (const int node : spider.nodes) pairs.insert(std::minmax(spider.reference, node));
  return pairs;
}

double longest_element(const MeshBuilder& builder) {
  double longest = 0.0;
  for (const std::vector<int>& nodes : builder.beam_nodes)
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
      longest = std::max(longest, (builder.position(nodes[k + 1]) - builder.position(nodes[k])).norm());
  return longest;
}

/// Nodes of other beams on the elements of one, by node.
class Line {
 public:
  Line(const MeshBuilder& builder, std::size_t number, const Pairs& tied)
      : builder_(builder), nodes_(builder.beam_nodes[number]), own_(nodes_.begin(), nodes_.end()), tied_(tied) {}

  std::set<int> touched(const NodeGrid& grid) const {
    std::set<int> found;
    for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
      const Vector3d middle = 0.5 * (builder_.position(nodes_[k]) + builder_.position(nodes_[k + 1]));
      grid.near(middle, [&](int node) {
        if (!own_.contains(node) && touches(nodes_[k], nodes_[k + 1], node)) found.insert(node);
      });
    }
    return found;
  }

 private:
  bool touches(int first, int second, int node) const {
    const Vector3d a = builder_.position(first), d = builder_.position(second) - a, x = builder_.position(node) - a;
    const double s = std::clamp(x.dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (x - s * d).norm() < touching * d.norm() && !tied_.contains(std::minmax(first, node)) &&
           !tied_.contains(std::minmax(second, node));
  }

  const MeshBuilder& builder_;
  const std::vector<int>& nodes_;
  std::set<int> own_;
  const Pairs& tied_;
};

}  // namespace

void tell_unjoined_beams(MeshBuilder& builder) {
  const double step = longest_element(builder);
  if (!(step > 0.0)) return;
  NodeGrid grid(step);
  std::set<int> added;
  for (const std::vector<int>& nodes : builder.beam_nodes)
    for (const int node : nodes)
      if (added.insert(node).second) grid.add(builder.position(node), node);
  const Pairs tied = tied_pairs(builder.mesh);
  Pairs met;  // nodes at the same place are met from both beams
  std::vector<std::string> texts;
  for (std::size_t b = 0; b < builder.beam_nodes.size(); ++b)
    for (const int node : Line(builder, b, tied).touched(grid)) {
      const Vector3d x = builder.position(node);
      const auto twin = std::ranges::find_if(builder.beam_nodes[b],
                                             [&](int n) { return (builder.position(n) - x).norm() < touching * step; });
      if (twin != builder.beam_nodes[b].end() && !met.insert(std::minmax(node, *twin)).second) continue;
      texts.push_back(fmt::format(
          "node {} lies on beam '{}' and is not joined to it: beams join only where they end, at points of one name; "
          "end '{}' there, or tie the two by a spring or spider",
          builder.label[node], builder.part.beams[b].name, builder.part.beams[b].name));
    }
  const std::size_t told = std::min(texts.size(), most_told);
  builder.mesh.warnings.insert(builder.mesh.warnings.end(), texts.begin(),
                               texts.begin() + static_cast<std::ptrdiff_t>(told));
  if (told < texts.size())
    builder.mesh.warnings.push_back(
        fmt::format("... and {} more nodes on beams to which they are not joined", texts.size() - told));
}

}  // namespace tisserand::reducer

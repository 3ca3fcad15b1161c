// SPDX-License-Identifier: GPL-3.0-or-later
// Ties between two nodes.
#include "reducer/sources/apart_on_purpose.hpp"

#include <algorithm>

namespace tisserand::reducer {

NodePairs tied_pairs(const Mesh& mesh) {
  NodePairs pairs;
  for (const Spring& spring : mesh.springs) pairs.insert(std::minmax(spring.first, spring.second));
  for (const Spider& spider : mesh.spiders)
    for (const int node : spider.nodes) pairs.insert(std::minmax(spider.reference, node));
  return pairs;
}

ApartOnPurpose::ApartOnPurpose(const Mesh& mesh) : tied_(tied_pairs(mesh)) {
  for (const TieEquation& equation : mesh.equations)
    for (const TieTerm& one : equation.terms)
      for (const TieTerm& other : equation.terms) tied_.insert(std::minmax(one.node, other.node));
  for (const Spider& spider : mesh.spiders)
    if (spider.kind == SpiderKind::rigid)
      for (const int node : spider.nodes) leads_[node].insert(spider.reference);
  for (const MeshBoundary& node : mesh.boundary) stays_.insert(node.node);
}

bool ApartOnPurpose::operator()(int a, int b) const {
  return tied_.contains(std::minmax(a, b)) || (stays_.contains(a) && stays_.contains(b)) || have_one_leader(a, b);
}

bool ApartOnPurpose::have_one_leader(int a, int b) const {
  const auto of_a = leads_.find(a), of_b = leads_.find(b);
  return of_a != leads_.end() && of_b != leads_.end() &&
         std::ranges::any_of(of_a->second, [&](int leader) { return of_b->second.contains(leader); });
}

}  // namespace tisserand::reducer

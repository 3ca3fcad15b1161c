// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes at the same place that are not merged: whether something ties them, or a joint may connect them.
#pragma once

#include <map>
#include <set>
#include <utility>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

using NodePairs = std::set<std::pair<int, int>>;

/// Pairs of nodes that a spring or a spider ties to each other. Such nodes may be at one place on purpose.
NodePairs tied_pairs(const Mesh& mesh);

/// Test whether two nodes at one place are separate on purpose. They are if a spring, a spider or an equation ties
/// them to each other, if they follow one rigid spider, or if both are boundary nodes, which a joint may connect.
class ApartOnPurpose {
 public:
  explicit ApartOnPurpose(const Mesh& mesh);
  bool operator()(int a, int b) const;

 private:
  bool have_one_leader(int a, int b) const;

  NodePairs tied_;
  std::map<int, std::set<int>> leads_;  ///< for each node: references of the rigid spiders that it follows
  std::set<int> stays_;
};

}  // namespace tisserand::reducer

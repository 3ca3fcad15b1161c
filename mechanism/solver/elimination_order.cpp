// SPDX-License-Identifier: GPL-3.0-or-later
// Minimum degree on the graph of blocks.
#include "mechanism/solver/elimination_order.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "common/math/count.hpp"

namespace tisserand::mechanism {
namespace {

using Blocks = std::vector<int>;  ///< ascending

/// Graph of the blocks that are not eliminated yet.
class BlockGraph {
 public:
  explicit BlockGraph(const SparsePattern& pattern);

  bool empty() const { return eligible_.empty(); }
  /// Removes the eligible block of least degree. Its neighbours become neighbours of each other.
  int eliminate();
  /// Number of unknowns in blocks.
  int weight(const Blocks& blocks) const;
  int weight(int block) const { return start_[block + 1] - start_[block]; }
  int start(int block) const { return start_[block]; }

 private:
  bool holds_multipliers(int block) const { return start_[block] >= first_multiplier_; }
  /// Blocks of coordinates come first among those of equal degree.
  std::pair<int, int> key(int block) const { return {2 * weight(near_[block]) + holds_multipliers(block), block}; }

  std::vector<int> start_;
  int first_multiplier_;
  std::vector<Blocks> near_;
  std::vector<bool> waits_;  ///< blocks of multipliers none of whose coordinates are eliminated
  std::set<std::pair<int, int>> eligible_;
};

BlockGraph::BlockGraph(const SparsePattern& pattern)
    : start_(pattern.blocks().start), first_multiplier_(pattern.blocks().first_multiplier) {
  const int count = count_of(start_);
  start_.push_back(pattern.size());
  std::vector<int> block_of(static_cast<std::size_t>(pattern.size()));
  for (int b = 0; b < count; ++b) std::fill(block_of.begin() + start_[b], block_of.begin() + start_[b + 1], b);
  near_.resize(static_cast<std::size_t>(count));
  for (int j = 0; j < pattern.size(); ++j)
    pattern.for_each_in(j, [&](int i, int) {
      const int a = block_of[i], b = block_of[j];
      if (a == b) return;
      if (near_[a].empty() || near_[a].back() != b) near_[a].push_back(b);
      if (near_[b].empty() || near_[b].back() != a) near_[b].push_back(a);
    });
  for (Blocks& blocks : near_) {
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  }
  waits_.resize(near_.size());
  for (int b = 0; b < count; ++b) {
    waits_[b] = holds_multipliers(b) && !near_[b].empty();
    if (!waits_[b]) eligible_.insert(key(b));
  }
}

int BlockGraph::weight(const Blocks& blocks) const {
  int sum = 0;
  for (const int block : blocks) sum += weight(block);
  return sum;
}

int BlockGraph::eliminate() {
  const int block = eligible_.begin()->second;
  eligible_.erase(eligible_.begin());
  const Blocks border = std::move(near_[block]);
  for (const int other : border) {
    if (!waits_[other]) eligible_.erase(key(other));
    Blocks merged;
    std::ranges::set_union(near_[other], border, std::back_inserter(merged));
    std::erase_if(merged, [&](int one) { return one == other || one == block; });
    near_[other] = std::move(merged);
    waits_[other] = false;
  }
  for (const int other : border) eligible_.insert(key(other));
  return block;
}

}  // namespace

std::vector<int> elimination_order(const SparsePattern& pattern) {
  BlockGraph graph(pattern);
  std::vector<int> order;
  while (!graph.empty()) {
    const int block = graph.eliminate();
    for (int k = 0; k < graph.weight(block); ++k) order.push_back(graph.start(block) + k);
  }
  return order;
}

}  // namespace tisserand::mechanism

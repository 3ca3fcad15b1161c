// SPDX-License-Identifier: GPL-3.0-or-later
// Greedy covering array of strength two: each choice takes a pair that is missing and what else is missing most.
#include "tests/support/crossings/pairs.hpp"

#include <cstddef>
#include <set>
#include <tuple>

namespace tisserand::test_support::crossings {
namespace {

/// Axis, value, later axis, value.
using Pair = std::tuple<int, int, int, int>;

std::set<Pair> all_pairs(const std::vector<int>& sizes) {
  std::set<Pair> pairs;
  const int axes = static_cast<int>(sizes.size());
  for (int i = 0; i < axes; ++i)
    for (int j = i + 1; j < axes; ++j)
      for (int a = 0; a < sizes[i]; ++a)
        for (int b = 0; b < sizes[j]; ++b) pairs.insert({i, a, j, b});
  return pairs;
}

Pair pair_of(int i, int a, int j, int b) { return i < j ? Pair{i, a, j, b} : Pair{j, b, i, a}; }

/// Missing pairs of value `a` of axis `i` with what is chosen already.
int gain(const Choice& choice, int i, int a, const std::set<Pair>& missing) {
  int count = 0;
  for (int j = 0; j < static_cast<int>(choice.size()); ++j)
    if (j != i && choice[j] >= 0) count += static_cast<int>(missing.count(pair_of(i, a, j, choice[j])));
  return count;
}

/// The choice that holds `first`; axes in their order take the value of the largest gain, those alike by turns.
Choice completed(const Pair& first, int turn, const std::vector<int>& sizes, const std::set<Pair>& missing) {
  Choice choice(sizes.size(), -1);
  const auto& [i, a, j, b] = first;
  choice[i] = a;
  choice[j] = b;
  for (int axis = 0; axis < static_cast<int>(sizes.size()); ++axis) {
    if (choice[axis] >= 0) continue;
    int best = -1, best_gain = -1;
    for (int k = 0; k < sizes[axis]; ++k) {
      const int value = (k + turn * (axis + 3)) % sizes[axis], now = gain(choice, axis, value, missing);
      if (now > best_gain) best = value, best_gain = now;
    }
    choice[axis] = best;
  }
  return choice;
}

}  // namespace

std::vector<Choice> pairwise(const std::vector<int>& sizes, const std::function<bool(const Choice&)>& sensible) {
  std::set<Pair> missing = all_pairs(sizes);
  std::vector<Choice> choices;
  int turn = 0;
  while (!missing.empty()) {
    const Pair first = *missing.begin();
    Choice choice;
    for (int attempt = 0; attempt < 60 && (choice.empty() || !sensible(choice)); ++attempt)
      choice = completed(first, turn++, sizes, attempt < 20 ? missing : std::set<Pair>{});
    if (!sensible(choice)) {  // no choice allows it
      missing.erase(first);
      continue;
    }
    for (int i = 0; i < static_cast<int>(sizes.size()); ++i)
      for (int j = i + 1; j < static_cast<int>(sizes.size()); ++j) missing.erase({i, choice[i], j, choice[j]});
    choices.push_back(choice);
  }
  return choices;
}

}  // namespace tisserand::test_support::crossings

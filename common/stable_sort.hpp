// SPDX-License-Identifier: GPL-3.0-or-later
// Stable sorting of objects of any alignment.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace tisserand {

/// Sorts `list` (std::vector, std::array) in place by `compare` of `projection` of its elements, stably. It sorts
/// indices, because std::stable_sort of GCC 12 aligns its buffer to 16 bytes only. That is undefined behaviour for
/// elements that hold, for example, an Eigen::Vector4d.
template <typename List, typename Compare = std::less<>, typename Projection = std::identity>
void sort_stably(List& list, Compare compare = {}, Projection projection = {}) {
  std::vector<std::size_t> order(list.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto before = [&](std::size_t a, std::size_t b) {
    return std::invoke(compare, std::invoke(projection, list[a]), std::invoke(projection, list[b]));
  };
  std::stable_sort(order.begin(), order.end(), before);
  std::vector<typename List::value_type> sorted;
  sorted.reserve(list.size());
  for (const std::size_t i : order) sorted.push_back(std::move(list[i]));
  std::move(sorted.begin(), sorted.end(), list.begin());
}

}  // namespace tisserand

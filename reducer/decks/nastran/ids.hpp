// SPDX-License-Identifier: GPL-3.0-or-later
// Tables from numbers of a Nastran deck (grid points, properties) to rows: dense if the numbers are, otherwise sorted.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace tisserand::reducer {

/// Table that finds the row of an identifying number, such as the id of a grid point.
class IdTable {
 public:
  /// Builds the table from identifying number ids[row] to row. Returns the rows whose number occurs in an earlier row.
  std::vector<int> build(const std::vector<long>& ids) {
    sorted_.clear();
    sorted_.reserve(ids.size());
    for (int row = 0; row < std::ssize(ids); ++row) sorted_.emplace_back(ids[row], row);
    std::sort(sorted_.begin(), sorted_.end());
    std::vector<int> again;
    for (std::size_t i = 1; i < sorted_.size(); ++i)
      if (sorted_[i].first == sorted_[i - 1].first) again.push_back(sorted_[i].second);
    fill_dense();
    return again;
  }

  /// First row with the number `id`, or −1.
  int find(long id) const {
    if (!dense_.empty()) return id < 0 || id >= static_cast<long>(dense_.size()) ? -1 : dense_[id];
    const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<long, int>(id, 0));
    return at != sorted_.end() && at->first == id ? at->second : -1;
  }

  /// Appends to `ids` the numbers from `first` to `last` that the table has.
  void between(long first, long last, std::vector<long>& ids) const {
    auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<long, int>(first, 0));
    for (long before = first - 1; at != sorted_.end() && at->first <= last; ++at) {
      if (at->first != before) ids.push_back(at->first);
      before = at->first;
    }
  }

 private:
  void fill_dense() {
    dense_.clear();
    if (sorted_.empty() || sorted_.front().first < 0) return;
    const auto largest = static_cast<std::size_t>(sorted_.back().first);
    if (largest > 8 * sorted_.size() + 1000) return;
    dense_.assign(largest + 1, -1);
    for (auto at = sorted_.rbegin(); at != sorted_.rend(); ++at) dense_[at->first] = at->second;
  }

  std::vector<std::pair<long, int>> sorted_;
  std::vector<int> dense_;
};

}  // namespace tisserand::reducer

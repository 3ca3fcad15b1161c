// SPDX-License-Identifier: GPL-3.0-or-later
// Compressed columns from positions, and the search for slots.
#include "mechanism/solver/sparse_pattern.hpp"

#include <algorithm>
#include <utility>

#include "common/error.hpp"
#include "common/math/count.hpp"

namespace tisserand::mechanism {

SparsePattern::SparsePattern(int size, std::vector<Position> positions, Storage storage, UnknownBlocks blocks)
    : size_(size), storage_(storage), blocks_(std::move(blocks)) {
  std::sort(positions.begin(), positions.end(), [](const Position& a, const Position& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  });
  positions.erase(
      std::unique(positions.begin(), positions.end(),
                  [](const Position& a, const Position& b) { return a.row == b.row && a.column == b.column; }),
      positions.end());
  nonzeros_ = count_of(positions);
  column_start_.assign(static_cast<std::size_t>(size) + 1, 0);
  rows_.reserve(positions.size());
  for (const Position& p : positions) {
    ++column_start_[static_cast<std::size_t>(p.column) + 1];
    rows_.push_back(p.row);
  }
  for (std::size_t j = 1; j < column_start_.size(); ++j) column_start_[j] += column_start_[j - 1];
  values_ = storage == Storage::dense ? size * size : nonzeros_;
}

int SparsePattern::slot(int row, int column) const {
  if (storage_ == Storage::dense) return row + column * size_;
  const auto begin = rows_.begin() + column_start_[column];
  const auto end = rows_.begin() + column_start_[static_cast<std::size_t>(column) + 1];
  const auto found = std::lower_bound(begin, end, row);
  TISSERAND_ENSURE(found != end && *found == row, "row {}, column {}", row, column);
  return static_cast<int>(found - rows_.begin());
}

}  // namespace tisserand::mechanism

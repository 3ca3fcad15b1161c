// SPDX-License-Identifier: GPL-3.0-or-later
// Positions of the values of a matrix: compressed columns, fixed when the model is built.
#pragma once

#include <vector>

namespace tisserand::mechanism {

/// Blocks of unknowns that are eliminated together: coordinates of a node, multipliers of a joint.
struct UnknownBlocks {
  std::vector<int> start;    ///< first unknown of each block, ascending from 0; empty if unknown
  int first_multiplier = 0;  ///< first of the unknowns that have zeros on the diagonal, up to the last one
};

/// Positions of the stored values of an n x n matrix, in compressed columns. With dense storage every position is
/// stored, and slot(i, j) = i + j n.
class SparsePattern {
 public:
  enum class Storage { sparse, dense };

  /// Row and column of an entry.
  struct Position {
    int row;
    int column;
  };
  /// Makes the pattern of `positions`, in which repeated positions are merged.
  SparsePattern(int size, std::vector<Position> positions, Storage storage, UnknownBlocks blocks = {});

  int size() const { return size_; }
  Storage storage() const { return storage_; }
  /// Number of stored values.
  int values() const { return values_; }
  /// Number of structural nonzeros (also for dense storage).
  int nonzeros() const { return nonzeros_; }
  /// Index in the stored values of position (row, column). Requires that the pattern has this position.
  int slot(int row, int column) const;
  /// Calls visit(row, slot) for each position of a column, in ascending order of rows.
  template <class Visit>
  void for_each_in(int column, Visit visit) const {
    for (int at = column_start_[column]; at < column_start_[static_cast<std::size_t>(column) + 1]; ++at)
      visit(rows_[at], storage_ == Storage::dense ? rows_[at] + column * size_ : at);
  }

  const std::vector<int>& column_start() const { return column_start_; }
  const std::vector<int>& rows() const { return rows_; }
  const UnknownBlocks& blocks() const { return blocks_; }

 private:
  int size_ = 0;
  Storage storage_ = Storage::sparse;
  int values_ = 0;
  int nonzeros_ = 0;
  std::vector<int> column_start_;
  std::vector<int> rows_;
  UnknownBlocks blocks_;
};

}  // namespace tisserand::mechanism

// Linear systems with one pattern and many values: symbolic once, numeric when the matrix changes, solve at will.
#pragma once

#include <memory>
#include <span>
#include <vector>

namespace tisserand::mechanism {

/// Compressed columns of an n x n matrix. Dense storage: every position exists, slot(i, j) = i + j n.
class SparsePattern {
 public:
  enum class Storage { sparse, dense };

  /// Positions may repeat; they are merged.
  struct Position {
    int row;
    int column;
  };
  SparsePattern(int size, std::vector<Position> positions, Storage storage);

  int size() const { return size_; }
  Storage storage() const { return storage_; }
  /// Number of stored values.
  int values() const { return values_; }
  /// Structural nonzeros (also for dense storage).
  int nonzeros() const { return nonzeros_; }
  /// Index into the values of position (row, column), which must be in the pattern.
  int slot(int row, int column) const;

  const std::vector<int>& column_start() const { return column_start_; }
  const std::vector<int>& rows() const { return rows_; }

 private:
  int size_ = 0;
  Storage storage_ = Storage::sparse;
  int values_ = 0;
  int nonzeros_ = 0;
  std::vector<int> column_start_;
  std::vector<int> rows_;
};

/// Outcome of a numeric factorisation. condition: estimate of the 1-norm condition by the ratio of pivots.
struct FactorReport {
  bool regular = false;
  double reciprocal_condition = 0.0;
  int singular_column = -1;  ///< where the elimination broke down, if known
};

/// The only door to SuiteSparse (KLU); small dense systems are solved here. No allocation in numeric() and solve()
/// after the first numeric().
class LinearSolver {
 public:
  explicit LinearSolver(const SparsePattern& pattern);  ///< symbolic
  ~LinearSolver();
  LinearSolver(LinearSolver&&) noexcept;
  LinearSolver& operator=(LinearSolver&&) noexcept;

  [[nodiscard]] FactorReport numeric(std::span<const double> values);
  /// In place.
  void solve(std::span<double> right_hand_side) const;
  /// Forgets pivots and factors, so that the next numeric() does what the first did.
  void forget();

  const char* name() const;

 private:
  struct Klu;
  struct Dense;
  const SparsePattern* pattern_;
  std::unique_ptr<Klu> klu_;
  std::unique_ptr<Dense> dense_;
};

}  // namespace tisserand::mechanism

// KLU for sparse patterns, LAPACK-style partial pivoting for small dense ones.
#include "mechanism/solver/linear_solver.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <klu.h>

#include "common/error.hpp"

namespace tisserand::mechanism {

SparsePattern::SparsePattern(int size, std::vector<Position> positions, Storage storage)
    : size_(size), storage_(storage) {
  std::sort(positions.begin(), positions.end(), [](const Position& a, const Position& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  });
  positions.erase(std::unique(positions.begin(), positions.end(),
                              [](const Position& a, const Position& b) { return a.row == b.row && a.column == b.column; }),
                  positions.end());
  nonzeros_ = static_cast<int>(positions.size());
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
  const auto begin = rows_.begin() + column_start_[static_cast<std::size_t>(column)];
  const auto end = rows_.begin() + column_start_[static_cast<std::size_t>(column) + 1];
  const auto found = std::lower_bound(begin, end, row);
  TISSERAND_ENSURE(found != end && *found == row, "row {}, column {}", row, column);
  return static_cast<int>(found - rows_.begin());
}

struct LinearSolver::Klu {
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;

  explicit Klu(const SparsePattern& pattern) {
    klu_defaults(&common);
    common.tol = 0.1;  // larger than the default 0.001: residuals of 1e-13 instead of 1e-12
    common.halt_if_singular = 1;
    if (pattern.size() == 0) return;
    symbolic = klu_analyze(pattern.size(), const_cast<int*>(pattern.column_start().data()),
                           const_cast<int*>(pattern.rows().data()), &common);
    TISSERAND_ENSURE(symbolic != nullptr, "KLU status {}", common.status);
  }
  ~Klu() {
    forget();
    if (symbolic) klu_free_symbolic(&symbolic, &common);
  }
  Klu(const Klu&) = delete;
  Klu& operator=(const Klu&) = delete;

  void forget() {
    if (numeric) klu_free_numeric(&numeric, &common);
    numeric = nullptr;
  }

  FactorReport factor(const SparsePattern& pattern, double* values) {
    int* start = const_cast<int*>(pattern.column_start().data());
    int* rows = const_cast<int*>(pattern.rows().data());
    if (numeric) {
      const bool kept = klu_refactor(start, rows, values, symbolic, numeric, &common) && common.status == KLU_OK &&
                        klu_rgrowth(start, rows, values, symbolic, numeric, &common) && common.rgrowth > 1e-8;
      if (kept) return report();
      forget();
    }
    numeric = klu_factor(start, rows, values, symbolic, &common);
    if (numeric == nullptr || common.status != KLU_OK) {
      const int column = common.singular_col;
      forget();
      return {false, 0.0, column < pattern.size() ? column : -1};
    }
    return report();
  }

  FactorReport report() {
    klu_rcond(symbolic, numeric, &common);
    return {common.rcond > 0.0 && std::isfinite(common.rcond), common.rcond, -1};
  }
};

struct LinearSolver::Dense {
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;
  Eigen::VectorXd permuted;  // Eigen's permutation in place allocates
  bool factored = false;

  explicit Dense(int n) : lu(n), permuted(n) {}

  FactorReport factor(int n, const double* values) {
    lu.compute(Eigen::Map<const Eigen::MatrixXd>(values, n, n));
    const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
    const double largest = n ? pivots.maxCoeff() : 1.0;
    Eigen::Index at = 0;
    const double smallest = n ? pivots.minCoeff(&at) : 1.0;
    factored = true;
    const bool regular = std::isfinite(largest) && smallest > 0.0;
    return {regular, regular ? smallest / largest : 0.0, regular ? -1 : static_cast<int>(at)};
  }

  void solve(double* right_hand_side) {
    Eigen::Map<Eigen::VectorXd> b(right_hand_side, permuted.size());
    permuted.noalias() = lu.permutationP() * b;
    lu.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(permuted);
    lu.matrixLU().triangularView<Eigen::Upper>().solveInPlace(permuted);
    b = permuted;
  }
};

LinearSolver::LinearSolver(const SparsePattern& pattern) : pattern_(&pattern) {
  if (pattern.storage() == SparsePattern::Storage::dense)
    dense_ = std::make_unique<Dense>(pattern.size());
  else
    klu_ = std::make_unique<Klu>(pattern);
}

LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

FactorReport LinearSolver::numeric(std::span<const double> values) {
  TISSERAND_ENSURE(static_cast<int>(values.size()) == pattern_->values(), "{} values", values.size());
  if (pattern_->size() == 0) return {true, 1.0, -1};
  for (const double value : values)
    if (!std::isfinite(value)) return {};
  if (dense_) return dense_->factor(pattern_->size(), values.data());
  return klu_->factor(*pattern_, const_cast<double*>(values.data()));
}

void LinearSolver::solve(std::span<double> right_hand_side) const {
  const int n = pattern_->size();
  TISSERAND_ENSURE(static_cast<int>(right_hand_side.size()) == n, "{} rows", right_hand_side.size());
  if (n == 0) return;
  if (dense_) {
    dense_->solve(right_hand_side.data());
    return;
  }
  klu_solve(klu_->symbolic, klu_->numeric, n, 1, right_hand_side.data(), &klu_->common);
}

void LinearSolver::forget() {
  if (klu_) klu_->forget();
}

const char* LinearSolver::name() const { return dense_ ? "dense LU" : "KLU"; }

}  // namespace tisserand::mechanism

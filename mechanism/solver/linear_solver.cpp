// KLU for sparse patterns, LU with partial pivoting for small dense ones.
#include "mechanism/solver/linear_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <klu.h>
#include <Eigen/Core>

#include "common/error.hpp"
#include "mechanism/bodies/column_kernels.hpp"

namespace tisserand::mechanism {

SparsePattern::SparsePattern(int size, std::vector<Position> positions, Storage storage)
    : size_(size), storage_(storage) {
  std::sort(positions.begin(), positions.end(), [](const Position& a, const Position& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  });
  positions.erase(
      std::unique(positions.begin(), positions.end(),
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

/// LU with partial pivoting by rank-one updates of whole registers. Columns are padded to multiples of four rows; the
/// zeros of L and U beside their triangles let every update start and end at a full register.
struct LinearSolver::Dense {
  int n = 0;
  int rows = 0;                  ///< leading dimension
  std::vector<double> lower;     ///< L without its unit diagonal, zeros elsewhere
  std::vector<double> upper;     ///< U without its diagonal, zeros elsewhere
  std::vector<double> diagonal;  ///< pivots, then their reciprocals
  std::vector<int> exchange;     ///< row k was exchanged with row exchange[k]
  std::vector<double> work;      ///< right-hand side

  explicit Dense(int size)
      : n(size),
        rows((size + 3) / 4 * 4),
        lower(static_cast<std::size_t>(rows) * static_cast<std::size_t>(size), 0.0),
        upper(lower),
        diagonal(static_cast<std::size_t>(size), 0.0),
        exchange(static_cast<std::size_t>(size), 0),
        work(static_cast<std::size_t>(rows), 0.0) {}

  /// y -= factor x in the registers that hold rows begin ... end - 1.
  static void subtract(double factor, const double* x, int begin, int end, double* y) {
    using column_kernels::load, column_kernels::store;
    for (int i = begin / 4 * 4; i < end; i += 4) store(y + i, load(y + i) - factor * load(x + i));
  }

  double* lower_column(int k) { return lower.data() + static_cast<std::ptrdiff_t>(rows) * k; }
  double* upper_column(int k) { return upper.data() + static_cast<std::ptrdiff_t>(rows) * k; }

  /// Brings the largest entry of column k to row k, in L and in what is left of the matrix.
  void exchange_rows(int k) {
    const double* a = upper_column(k);
    int largest = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a[i]) > std::abs(a[largest])) largest = i;
    exchange[static_cast<std::size_t>(k)] = largest;
    if (largest == k) return;
    for (int j = 0; j < k; ++j) std::swap(lower_column(j)[k], lower_column(j)[largest]);
    for (int j = k; j < n; ++j) std::swap(upper_column(j)[k], upper_column(j)[largest]);
  }

  FactorReport factor(const double* values) {
    for (int j = 0; j < n; ++j) std::copy_n(values + static_cast<std::ptrdiff_t>(n) * j, n, upper_column(j));
    double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
    int weakest = -1;
    for (int k = 0; k < n; ++k) {
      exchange_rows(k);
      double *u = upper_column(k), *l = lower_column(k);
      const double pivot = u[k], size = std::abs(pivot);
      if (!(size > 0.0) || !std::isfinite(size)) return {false, 0.0, k};
      if (size < smallest) {
        smallest = size;
        weakest = k;
      }
      largest = std::max(largest, size);
      diagonal[static_cast<std::size_t>(k)] = 1.0 / pivot;
      std::fill_n(l, k + 1, 0.0);
      for (int i = k + 1; i < n; ++i) l[i] = u[i] / pivot;
      std::fill_n(u + k, n - k, 0.0);
      for (int j = k + 1; j < n; ++j)
        if (const double entry = upper_column(j)[k]; entry != 0.0) subtract(entry, l, k + 1, n, upper_column(j));
    }
    const double ratio = smallest / largest;
    return {ratio > 0.0, ratio, ratio > 0.0 ? -1 : weakest};
  }

  void solve(double* b) {
    std::copy_n(b, n, work.data());
    for (int k = 0; k < n; ++k)
      std::swap(work[static_cast<std::size_t>(k)],
                work[static_cast<std::size_t>(exchange[static_cast<std::size_t>(k)])]);
    for (int k = 0; k < n; ++k) subtract(work[static_cast<std::size_t>(k)], lower_column(k), k + 1, n, work.data());
    for (int k = n - 1; k >= 0; --k) {
      const double x = work[static_cast<std::size_t>(k)] * diagonal[static_cast<std::size_t>(k)];
      subtract(x, upper_column(k), 0, k, work.data());
      b[k] = x;
    }
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
  // 0 if all are finite, else NaN.
  if ((0.0 * Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size()))).sum() != 0.0)
    return {};
  if (dense_) return dense_->factor(values.data());
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

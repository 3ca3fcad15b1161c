// Dense LU behind the back-end shape: a small one of our own, and LAPACK's.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Core>

#include "common/math/column_kernels.hpp"
#include "mechanism/solver/back_ends.hpp"

extern "C" {
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* ipiv, int* info);
void dgetrs_(const char* trans, const int* n, const int* nrhs, const double* a, const int* lda, const int* ipiv,
             double* b, const int* ldb, int* info);
}

namespace tisserand::mechanism::back_end {
namespace {

/// y -= factor x in the registers that hold rows begin ... end - 1.
void subtract(double factor, const double* x, int begin, int end, double* y) {
  using column_kernels::load, column_kernels::store;
  for (int i = begin / 4 * 4; i < end; i += 4) store(y + i, load(y + i) - factor * load(x + i));
}

/// y -= Σ factor[c] x[c], c = 0 ... 3, from row begin to row end - 1, multiples of 4; x: columns, `rows` apart.
void subtract_four(const double (&factor)[4], const double* x, int rows, int begin, int end, double* y) {
  using column_kernels::load, column_kernels::store;
  const double *x0 = x, *x1 = x0 + rows, *x2 = x1 + rows, *x3 = x2 + rows;
  for (int i = begin; i < end; i += 4)
    store(y + i, load(y + i) - factor[0] * load(x0 + i) - factor[1] * load(x1 + i) - factor[2] * load(x2 + i) -
                     factor[3] * load(x3 + i));
}

double largest(const double* column, int size) {
  return Eigen::Map<const Eigen::ArrayXd>(column, size).abs().maxCoeff();
}

}  // namespace

SmallDense::SmallDense(const SparsePattern& pattern)
    : n_(pattern.size()),
      rows_((n_ + 3) / 4 * 4),
      lower_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(rows_), 0.0),
      upper_(lower_),
      diagonal_(static_cast<std::size_t>(rows_), 0.0),
      order_(static_cast<std::size_t>(n_), 0),
      work_(static_cast<std::size_t>(rows_), 0.0) {}

/// Brings the largest entry of column k to row k, in L and in what is left of the matrix. Its size is known before its
/// place: the search for both at once waits for each comparison. Returns the size; not a number if one of them is none.
double SmallDense::exchange_rows(int k) {
  const double* a = upper_column(k);
  const double size = Eigen::Map<const Eigen::ArrayXd>(a + k, n_ - k).abs().maxCoeff<Eigen::PropagateNaN>();
  int pivot = k;
  while (pivot < n_ - 1 && std::abs(a[pivot]) < size) ++pivot;
  if (pivot == k) return size;
  std::swap(order_[k], order_[pivot]);
  for (int j = 0; j < k; ++j) std::swap(lower_column(j)[k], lower_column(j)[pivot]);
  for (int j = k; j < n_; ++j) std::swap(upper_column(j)[k], upper_column(j)[pivot]);
  return size;
}

FactorReport SmallDense::factor(const SparsePattern&, const double* values) {
  for (int j = 0; j < n_; ++j) {
    std::copy_n(values + static_cast<std::ptrdiff_t>(n_) * j, n_, upper_column(j));
    std::fill_n(upper_column(j) + n_, rows_ - n_, 0.0);
  }
  std::iota(order_.begin(), order_.end(), 0);
  double smallest = std::numeric_limits<double>::infinity(), greatest = 0.0;
  int weakest = -1;
  for (int k = 0; k < n_; ++k) {
    const double size = exchange_rows(k);
    double *u = upper_column(k), *l = lower_column(k);
    const double pivot = u[k];
    if (!(size > 0.0) || !std::isfinite(size)) return {false, 0.0, k, 1.0};
    if (size < smallest) {
      smallest = size;
      weakest = k;
    }
    greatest = std::max(greatest, size);
    diagonal_[k] = 1.0 / pivot;
    std::fill_n(l, k + 1, 0.0);
    for (int i = k + 1; i < n_; ++i) l[i] = u[i] / pivot;
    std::fill_n(u + k, n_ - k, 0.0);
    for (int j = k + 1; j < n_; ++j)
      if (const double entry = upper_column(j)[k]; entry != 0.0) subtract(entry, l, k + 1, n_, upper_column(j));
  }
  const double ratio = smallest / greatest;
  return {ratio > 0.0, ratio, ratio > 0.0 ? -1 : weakest, 1.0};
}

/// Four rows at a time, by numbers in the triangle on the diagonal and by registers in the rest; what is behind row n
/// is zero.
void SmallDense::solve(const SparsePattern&, const double*, double* b) {
  double* w = work_.data();
  for (int k = 0; k < n_; ++k) w[k] = b[order_[k]];
  std::fill_n(w + n_, rows_ - n_, 0.0);
  for (int k = 0; k < rows_; k += 4) {
    const double *l0 = lower_column(k), *l1 = lower_column(k + 1), *l2 = lower_column(k + 2);
    const double x0 = w[k], x1 = w[k + 1] - l0[k + 1] * x0, x2 = w[k + 2] - l0[k + 2] * x0 - l1[k + 2] * x1;
    const double x3 = w[k + 3] - l0[k + 3] * x0 - l1[k + 3] * x1 - l2[k + 3] * x2;
    w[k + 1] = x1, w[k + 2] = x2, w[k + 3] = x3;
    subtract_four({x0, x1, x2, x3}, l0, rows_, k + 4, rows_, w);
  }
  for (int k = rows_ - 4; k >= 0; k -= 4) {
    const double *u1 = upper_column(k + 1), *u2 = upper_column(k + 2), *u3 = upper_column(k + 3);
    const double* d = diagonal_.data() + k;
    const double x3 = w[k + 3] * d[3], x2 = (w[k + 2] - u3[k + 2] * x3) * d[2];
    const double x1 = (w[k + 1] - u3[k + 1] * x3 - u2[k + 1] * x2) * d[1];
    const double x0 = (w[k] - u3[k] * x3 - u2[k] * x2 - u1[k] * x1) * d[0];
    w[k] = x0, w[k + 1] = x1, w[k + 2] = x2, w[k + 3] = x3;
    subtract_four({x0, x1, x2, x3}, upper_column(k), rows_, 0, k, w);
  }
  std::copy_n(w, n_, b);
}

void SmallDense::solve_transposed(const SparsePattern&, const double*, double* b) {
  using ConstMap = Eigen::Map<const Eigen::VectorXd>;
  for (int k = 0; k < n_; ++k)  // Uᵀ
    b[k] = (b[k] - ConstMap(upper_column(k), k).dot(ConstMap(b, k))) * diagonal_[k];
  for (int k = n_ - 1; k >= 0; --k)  // Lᵀ
    b[k] -= ConstMap(lower_column(k) + k + 1, n_ - k - 1).dot(ConstMap(b + k + 1, n_ - k - 1));
  std::copy_n(b, n_, work_.data());
  for (int k = 0; k < n_; ++k) b[order_[k]] = work_[k];
}

double SmallDense::reciprocal_growth(const SparsePattern&, const double* values) {
  double growth = 1.0;
  for (int j = 0; j < n_; ++j) {
    const double u = std::max(largest(upper_column(j), n_), 1.0 / std::abs(diagonal_[j]));
    growth = std::min(growth, largest(values + static_cast<std::ptrdiff_t>(n_) * j, n_) / u);
  }
  return growth;
}

Lapack::Lapack(const SparsePattern& pattern)
    : n_(pattern.size()),
      factors_(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_), 0.0),
      exchange_(static_cast<std::size_t>(n_), 0) {}

FactorReport Lapack::factor(const SparsePattern&, const double* values) {
  std::copy_n(values, factors_.size(), factors_.data());
  int info = 0;
  dgetrf_(&n_, &n_, factors_.data(), &n_, exchange_.data(), &info);
  if (info > 0) return {false, 0.0, info - 1, 1.0};
  const auto pivots = Eigen::Map<const Eigen::MatrixXd>(factors_.data(), n_, n_).diagonal().array().abs();
  Eigen::Index weakest = 0;
  const double ratio = pivots.minCoeff(&weakest) / pivots.maxCoeff();
  return {ratio > 0.0, ratio, ratio > 0.0 ? -1 : static_cast<int>(weakest), 1.0};
}

void Lapack::solve(const SparsePattern&, const double*, double* b) {
  const int one = 1;
  int info = 0;
  dgetrs_("N", &n_, &one, factors_.data(), &n_, exchange_.data(), b, &n_, &info);
}

void Lapack::solve_transposed(const SparsePattern&, const double*, double* b) {
  const int one = 1;
  int info = 0;
  dgetrs_("T", &n_, &one, factors_.data(), &n_, exchange_.data(), b, &n_, &info);
}

double Lapack::reciprocal_growth(const SparsePattern&, const double* values) {
  double growth = 1.0;
  for (int j = 0; j < n_; ++j) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(n_) * j;
    growth = std::min(growth, largest(values + at, n_) / largest(factors_.data() + at, j + 1));
  }
  return growth;
}

}  // namespace tisserand::mechanism::back_end

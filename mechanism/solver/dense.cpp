// SPDX-License-Identifier: GPL-3.0-or-later
// Dense LU as back ends: an own one for small systems, and LAPACK's.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/math/column_kernels.hpp"
#include "mechanism/solver/back_ends.hpp"

extern "C" {
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* ipiv, int* info);
void dgetrs_(const char* trans, const int* n, const int* nrhs, const double* a, const int* lda, const int* ipiv,
             double* b, const int* ldb, int* info);
void zgetrf_(const int* m, const int* n, std::complex<double>* a, const int* lda, int* ipiv, int* info);
void zgetrs_(const char* trans, const int* n, const int* nrhs, const std::complex<double>* a, const int* lda,
             const int* ipiv, std::complex<double>* b, const int* ldb, int* info);
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

template <class Scalar>
double largest(const Scalar* column, int size) {
  return Eigen::Map<const Eigen::Array<Scalar, Eigen::Dynamic, 1>>(column, size).abs().maxCoeff();
}

/// Dense LU for small systems. Columns are padded to multiples of four rows. Zeros outside the triangles of L and U let
/// every update start and end at a full register.
class SmallDense : public BackEnd {
 public:
  explicit SmallDense(const SparsePattern& pattern);
  FactorReport factor(const double* values) override;
  void solve(double* b) override;
  void solve_transposed(double* b) override;
  double reciprocal_growth() override;

 private:
  double* lower_column(int k) { return lower_.data() + static_cast<std::ptrdiff_t>(rows_) * k; }
  double* upper_column(int k) { return upper_.data() + static_cast<std::ptrdiff_t>(rows_) * k; }
  double exchange_rows(int k);

  int n_ = 0;
  int rows_ = 0;  ///< leading dimension and number of columns: multiple of four, zeros after n
  const double* values_ = nullptr;
  std::vector<double> lower_;     ///< L without its unit diagonal, zeros elsewhere
  std::vector<double> upper_;     ///< U without its diagonal, zeros elsewhere
  std::vector<double> diagonal_;  ///< reciprocals of the pivots
  std::vector<int> order_;        ///< row k of the factors is row order[k] of the matrix
  std::vector<double> work_;      ///< right-hand side
};

SmallDense::SmallDense(const SparsePattern& pattern)
    : n_(pattern.size()),
      rows_((n_ + 3) / 4 * 4),
      lower_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(rows_), 0.0),
      upper_(lower_),
      diagonal_(static_cast<std::size_t>(rows_), 0.0),
      order_(static_cast<std::size_t>(n_), 0),
      work_(static_cast<std::size_t>(rows_), 0.0) {}

/// Swaps the largest entry of column k to row k, in L and in the remaining matrix. Finds the maximum first, then its
/// index: a combined search cannot be vectorised. Returns the maximum; not-a-number if the column contains one.
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

FactorReport SmallDense::factor(const double* values) {
  values_ = values;
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

/// Solves four rows at a time, with scalars in the triangle on the diagonal and with registers in the rest. Entries
/// after row n are zero.
void SmallDense::solve(double* b) {
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

void SmallDense::solve_transposed(double* b) {
  using ConstMap = Eigen::Map<const Eigen::VectorXd>;
  for (int k = 0; k < n_; ++k)  // Uᵀ
    b[k] = (b[k] - ConstMap(upper_column(k), k).dot(ConstMap(b, k))) * diagonal_[k];
  for (int k = n_ - 1; k >= 0; --k)  // Lᵀ
    b[k] -= ConstMap(lower_column(k) + k + 1, n_ - k - 1).dot(ConstMap(b + k + 1, n_ - k - 1));
  std::copy_n(b, n_, work_.data());
  for (int k = 0; k < n_; ++k) b[order_[k]] = work_[k];
}

double SmallDense::reciprocal_growth() {
  double growth = 1.0;
  for (int j = 0; j < n_; ++j) {
    const double u = std::max(largest(upper_column(j), n_), 1.0 / std::abs(diagonal_[j]));
    growth = std::min(growth, largest(values_ + static_cast<std::ptrdiff_t>(n_) * j, n_) / u);
  }
  return growth;
}

void getrf(int n, double* a, int* pivots, int* info) { dgetrf_(&n, &n, a, &n, pivots, info); }
void getrf(int n, std::complex<double>* a, int* pivots, int* info) { zgetrf_(&n, &n, a, &n, pivots, info); }
void getrs(const char* which, int n, const double* a, const int* pivots, double* b) {
  const int one = 1;
  int info = 0;
  dgetrs_(which, &n, &one, a, &n, pivots, b, &n, &info);
}
void getrs(const char* which, int n, const std::complex<double>* a, const int* pivots, std::complex<double>* b) {
  const int one = 1;
  int info = 0;
  zgetrs_(which, &n, &one, a, &n, pivots, b, &n, &info);
}

template <class Scalar>
class Lapack : public BackEnd {
 public:
  explicit Lapack(const SparsePattern& pattern)
      : n_(pattern.size()),
        factors_(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_)),
        exchange_(static_cast<std::size_t>(n_), 0) {}

  FactorReport factor(const double* values) override {
    values_ = reinterpret_cast<const Scalar*>(values);
    std::copy_n(values_, factors_.size(), factors_.data());
    int info = 0;
    getrf(n_, factors_.data(), exchange_.data(), &info);
    if (info > 0) return {false, 0.0, info - 1, 1.0};
    using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    const auto pivots = Eigen::Map<const Matrix>(factors_.data(), n_, n_).diagonal().array().abs();
    Eigen::Index weakest = 0;
    const double ratio = pivots.minCoeff(&weakest) / pivots.maxCoeff();
    return {ratio > 0.0, ratio, ratio > 0.0 ? -1 : static_cast<int>(weakest), 1.0};
  }

  void solve(double* b) override { getrs("N", n_, factors_.data(), exchange_.data(), reinterpret_cast<Scalar*>(b)); }
  void solve_transposed(double* b) override {
    getrs("T", n_, factors_.data(), exchange_.data(), reinterpret_cast<Scalar*>(b));
  }

  double reciprocal_growth() override {
    double growth = 1.0;
    for (int j = 0; j < n_; ++j) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(n_) * j;
      growth = std::min(growth, largest(values_ + at, n_) / largest(factors_.data() + at, j + 1));
    }
    return growth;
  }

 private:
  int n_ = 0;
  const Scalar* values_ = nullptr;
  std::vector<Scalar> factors_;
  std::vector<int> exchange_;
};

}  // namespace

std::unique_ptr<BackEnd> make_small_dense(const SparsePattern& pattern) {
  return std::make_unique<SmallDense>(pattern);
}

std::unique_ptr<BackEnd> make_lapack(const SparsePattern& pattern, Numbers numbers) {
  if (numbers == Numbers::real) return std::make_unique<Lapack<double>>(pattern);
  return std::make_unique<Lapack<std::complex<double>>>(pattern);
}

}  // namespace tisserand::mechanism::back_end

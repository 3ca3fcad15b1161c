// SuiteSparseQR behind the back-end shape: A P = Q R.
#include <SuiteSparseQR.hpp>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "mechanism/solver/back_ends.hpp"

namespace tisserand::mechanism::back_end {

struct SparseQr::Data {
  cholmod_common common{};
  std::vector<SuiteSparse_long> starts, rows;
  cholmod_sparse matrix{};
  SuiteSparseQR_factorization<double>* factors = nullptr;

  ~Data() {
    if (factors) SuiteSparseQR_free(&factors, &common);
    cholmod_l_finish(&common);
  }

  /// b <- second(first(b)) for the two halves of a solution.
  template <class First, class Second>
  void solve(double* b, First first, Second second) {
    cholmod_dense right{};
    right.nrow = right.nzmax = right.d = matrix.nrow;
    right.ncol = 1;
    right.x = b;
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* half = first(&right);
    cholmod_dense* whole = second(half);
    TISSERAND_ENSURE(whole != nullptr, "status {}", common.status);
    std::copy_n(static_cast<double*>(whole->x), matrix.nrow, b);
    cholmod_l_free_dense(&half, &common);
    cholmod_l_free_dense(&whole, &common);
  }

  cholmod_dense* rotate(int method, cholmod_dense* b) {
    return SuiteSparseQR_qmult<double>(method, factors, b, &common);
  }
  cholmod_dense* triangle(int system, cholmod_dense* b) {
    return SuiteSparseQR_solve<double>(system, factors, b, &common);
  }
};

SparseQr::SparseQr(const SparsePattern& pattern) : data_(std::make_unique<Data>()) {
  cholmod_l_start(&data_->common);
  data_->common.print = 0;
  data_->starts.assign(pattern.column_start().begin(), pattern.column_start().end());
  data_->rows.assign(pattern.rows().begin(), pattern.rows().end());
  cholmod_sparse& A = data_->matrix;
  A.nrow = A.ncol = static_cast<std::size_t>(pattern.size());
  A.nzmax = data_->rows.size();
  A.p = data_->starts.data();
  A.i = data_->rows.data();
  A.itype = CHOLMOD_LONG;
  A.xtype = CHOLMOD_REAL;
  std::vector<double> values(data_->rows.size(), 0.0);  // not looked at, but demanded
  A.x = values.data();
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  data_->factors = SuiteSparseQR_symbolic<double>(SPQR_ORDERING_DEFAULT, 1, &A, &data_->common);
  TISSERAND_ENSURE(data_->factors != nullptr, "status {}", data_->common.status);
}

SparseQr::~SparseQr() = default;

void SparseQr::forget() {}

FactorReport SparseQr::factor(const SparsePattern& pattern, const double* values) {
  cholmod_sparse& A = data_->matrix;
  A.x = const_cast<double*>(values);
  double largest = 0.0;
  for (int k = 0; k < pattern.values(); ++k) largest = std::max(largest, std::abs(values[k]));
  const double tolerance = 1e-18 * largest;  // columns without a part of their own; poor ones show in the condition
  const int done = SuiteSparseQR_numeric<double>(tolerance, &A, data_->factors, &data_->common);
  TISSERAND_ENSURE(done, "status {}", data_->common.status);
  const auto& qr = *data_->factors;
  for (SuiteSparse_long k = 0; k < qr.nacols && qr.rank < qr.nacols; ++k)
    if (qr.Rmap[k] >= qr.rank) return {false, 0.0, static_cast<int>(qr.Q1fill ? qr.Q1fill[k] : k), 1.0};
  return {true, 1.0, -1, 1.0};
}

void SparseQr::solve(const SparsePattern&, const double*, double* b) {
  data_->solve(
      b, [this](cholmod_dense* x) { return data_->rotate(SPQR_QTX, x); },
      [this](cholmod_dense* x) { return data_->triangle(SPQR_RETX_EQUALS_B, x); });
}

void SparseQr::solve_transposed(const SparsePattern&, const double*, double* b) {
  data_->solve(
      b, [this](cholmod_dense* x) { return data_->triangle(SPQR_RTX_EQUALS_ETB, x); },
      [this](cholmod_dense* x) { return data_->rotate(SPQR_QX, x); });
}

double SparseQr::reciprocal_growth(const SparsePattern&, const double*) { return 1.0; }

}  // namespace tisserand::mechanism::back_end

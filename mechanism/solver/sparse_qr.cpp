// SPDX-License-Identifier: GPL-3.0-or-later
// SuiteSparseQR as a back end: A P = Q R.
#include <SuiteSparseQR.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/error.hpp"
#include "mechanism/solver/back_ends.hpp"

namespace tisserand::mechanism::back_end {
namespace {

class SparseQr : public BackEnd {
 public:
  explicit SparseQr(const SparsePattern& pattern)
      : starts_(pattern.column_start().begin(), pattern.column_start().end()),
        rows_(pattern.rows().begin(), pattern.rows().end()) {
    cholmod_l_start(&common_);
    common_.print = 0;
    cholmod_sparse& A = matrix_;
    A.nrow = A.ncol = static_cast<std::size_t>(pattern.size());
    A.nzmax = rows_.size();
    A.p = starts_.data();
    A.i = rows_.data();
    A.itype = CHOLMOD_LONG;
    A.xtype = CHOLMOD_REAL;
    std::vector<double> values(rows_.size(), 0.0);  // required by the interface, but not used
    A.x = values.data();
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = A.packed = 1;
    factors_ = SuiteSparseQR_symbolic<double>(SPQR_ORDERING_DEFAULT, 1, &A, &common_);
    TISSERAND_ENSURE(factors_ != nullptr, "status {}", common_.status);
  }
  ~SparseQr() override {
    if (factors_) SuiteSparseQR_free(&factors_, &common_);
    cholmod_l_finish(&common_);
  }

  FactorReport factor(const double* values) override {
    matrix_.x = const_cast<double*>(values);
    double largest = 0.0;
    for (std::size_t k = 0; k < rows_.size(); ++k) largest = std::max(largest, std::abs(values[k]));
    const double tolerance = 1e-18 * largest;  // only columns that depend exactly; poor ones show in the condition
    const int done = SuiteSparseQR_numeric<double>(tolerance, &matrix_, factors_, &common_);
    TISSERAND_ENSURE(done, "status {}", common_.status);
    const auto& qr = *factors_;
    for (SuiteSparse_long k = 0; k < qr.nacols && qr.rank < qr.nacols; ++k)
      if (qr.Rmap[k] >= qr.rank) return {false, 0.0, static_cast<int>(qr.Q1fill ? qr.Q1fill[k] : k), 1.0};
    return {true, 1.0, -1, 1.0};
  }

  void solve(double* b) override {
    in_halves(
        b, [this](cholmod_dense* x) { return rotate(SPQR_QTX, x); },
        [this](cholmod_dense* x) { return triangle(SPQR_RETX_EQUALS_B, x); });
  }
  void solve_transposed(double* b) override {
    in_halves(
        b, [this](cholmod_dense* x) { return triangle(SPQR_RTX_EQUALS_ETB, x); },
        [this](cholmod_dense* x) { return rotate(SPQR_QX, x); });
  }

 private:
  /// Replaces b by second(first(b)), the two halves of a solution.
  template <class First, class Second>
  void in_halves(double* b, First first, Second second) {
    cholmod_dense right{};
    right.nrow = right.nzmax = right.d = matrix_.nrow;
    right.ncol = 1;
    right.x = b;
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* half = first(&right);
    cholmod_dense* whole = second(half);
    TISSERAND_ENSURE(whole != nullptr, "status {}", common_.status);
    std::copy_n(static_cast<double*>(whole->x), matrix_.nrow, b);
    cholmod_l_free_dense(&half, &common_);
    cholmod_l_free_dense(&whole, &common_);
  }
  cholmod_dense* rotate(int method, cholmod_dense* b) {
    return SuiteSparseQR_qmult<double>(method, factors_, b, &common_);
  }
  cholmod_dense* triangle(int system, cholmod_dense* b) {
    return SuiteSparseQR_solve<double>(system, factors_, b, &common_);
  }

  cholmod_common common_{};
  std::vector<SuiteSparse_long> starts_, rows_;
  cholmod_sparse matrix_{};
  SuiteSparseQR_factorization<double>* factors_ = nullptr;
};

}  // namespace

std::unique_ptr<BackEnd> make_sparse_qr(const SparsePattern& pattern) { return std::make_unique<SparseQr>(pattern); }

}  // namespace tisserand::mechanism::back_end

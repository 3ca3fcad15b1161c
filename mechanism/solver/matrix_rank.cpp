// SPDX-License-Identifier: GPL-3.0-or-later
// Rank-revealing sparse QR; pseudo-inverse by a complete orthogonal decomposition or conjugate gradients.
#include "mechanism/solver/matrix_rank.hpp"

#include <SuiteSparseQR.hpp>

#include <algorithm>
#include <new>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/QR>

#include "common/error.hpp"

namespace tisserand::mechanism {
namespace {

/// Largest number of columns for a dense decomposition. A QR of 400 x 400 takes 15 ms. Above, conjugate gradients are
/// faster.
constexpr int dense_columns = 400;

}  // namespace

ColumnRank column_rank(const Eigen::SparseMatrix<double>& A, double tolerance) {
  const Eigen::Index entries = A.nonZeros();
  std::vector<SuiteSparse_long> starts(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1);
  std::vector<SuiteSparse_long> rows(A.innerIndexPtr(), A.innerIndexPtr() + entries);
  cholmod_sparse matrix{};
  matrix.nrow = static_cast<std::size_t>(A.rows());
  matrix.ncol = static_cast<std::size_t>(A.cols());
  matrix.nzmax = rows.size();
  matrix.p = starts.data();
  matrix.i = rows.data();
  matrix.x = const_cast<double*>(A.valuePtr());
  matrix.itype = CHOLMOD_LONG;
  matrix.xtype = CHOLMOD_REAL;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = matrix.packed = 1;

  cholmod_common common{};
  cholmod_l_start(&common);
  common.print = 0;
  SuiteSparseQR_factorization<double>* qr =
      SuiteSparseQR_factorize<double>(SPQR_ORDERING_DEFAULT, tolerance, &matrix, &common);
  if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
  TISSERAND_ENSURE(qr != nullptr, "status {}", common.status);
  ColumnRank result;
  result.rank = static_cast<int>(qr->rank);
  for (SuiteSparse_long k = 0; k < qr->nacols && qr->rank < qr->nacols; ++k)
    if (qr->Rmap[k] >= qr->rank) result.dependent.push_back(static_cast<int>(qr->Q1fill ? qr->Q1fill[k] : k));
  std::sort(result.dependent.begin(), result.dependent.end());
  SuiteSparseQR_free(&qr, &common);
  cholmod_l_finish(&common);
  return result;
}

Eigen::VectorXd without_null_space(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& x, double tolerance) {
  if (A.cols() == 0) return x;  // Eigen's decompositions need a column
  const Eigen::VectorXd f = A * x;
  if (A.cols() <= dense_columns) {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(tolerance);
    decomposition.compute(Eigen::MatrixXd(A));
    return decomposition.solve(f);
  }
  Eigen::LeastSquaresConjugateGradient<Eigen::SparseMatrix<double>> solver(A);
  solver.setTolerance(1e-12);
  solver.setMaxIterations(10 * A.cols());
  return solver.solve(f);
}

}  // namespace tisserand::mechanism

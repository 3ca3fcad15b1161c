// Rank-revealing sparse QR.
#include "mechanism/solver/matrix_rank.hpp"

#include <SuiteSparseQR.hpp>

#include <algorithm>

#include "common/error.hpp"

namespace tisserand::mechanism {

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

}  // namespace tisserand::mechanism

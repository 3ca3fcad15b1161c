// MUMPS through PETSc's Cholesky interface.
#include "reducer/algebra/factor.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <petscmat.h>

#include "common/error.hpp"

namespace tisserand::reducer {

Factor::Factor(const Matrix& A, double null_pivot) {
  PetscInt n = 0;
  petsc_check(MatGetSize(A.get(), &n, nullptr));
  size_ = n;
  MatFactorInfo info;
  petsc_check(MatFactorInfoInitialize(&info));
  petsc_check(MatGetFactor(A.get(), MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor_.out()));
  petsc_check(MatMumpsSetIcntl(factor_.get(), 24, 1));         // null pivots are found, not fatal
  petsc_check(MatMumpsSetCntl(factor_.get(), 3, null_pivot));  // ... below this share of the scaled matrix's norm
  petsc_check(MatMumpsSetIcntl(factor_.get(), 14, 60));        // per cent of memory beyond the estimate, for pivoting
  petsc_check(MatCholeskyFactorSymbolic(factor_.get(), A.get(), nullptr, &info));
  petsc_check(MatCholeskyFactorNumeric(factor_.get(), A.get(), &info));
  MatFactorError failure = MAT_FACTOR_NOERROR;
  petsc_check(MatFactorGetError(factor_.get(), &failure));
  PetscInt null = 0, negative = 0, code = 0;
  petsc_check(MatMumpsGetInfog(factor_.get(), 1, &code));
  if (failure != MAT_FACTOR_NOERROR || code < 0)
    throw Error(fmt::format("MUMPS cannot factor a matrix of {} rows (INFOG(1) = {})", n, code), "factorisation",
                failure == MAT_FACTOR_OUTMEMORY || code == -9 || code == -13
                    ? "the memory of this machine does not suffice: use fewer elements"
                    : "please report this with the part file");
  petsc_check(MatMumpsGetInfog(factor_.get(), 28, &null));
  petsc_check(MatMumpsGetInfog(factor_.get(), 12, &negative));
  null_ = null;
  negative_ = negative;
}

Eigen::MatrixXd Factor::solve(const Eigen::MatrixXd& B) const {
  constexpr Eigen::Index block = 32;
  Eigen::MatrixXd X(B.rows(), B.cols());
  if (B.rows() == 0) return X;
  for (Eigen::Index first = 0; first < B.cols(); first += block) {
    const PetscInt count = static_cast<PetscInt>(std::min(block, B.cols() - first));
    Matrix b, x;
    petsc_check(MatCreateSeqDense(PETSC_COMM_SELF, size_, count, const_cast<double*>(B.col(first).data()), b.out()));
    petsc_check(MatCreateSeqDense(PETSC_COMM_SELF, size_, count, X.col(first).data(), x.out()));
    for (const Matrix* m : {&b, &x}) {
      petsc_check(MatAssemblyBegin(m->get(), MAT_FINAL_ASSEMBLY));
      petsc_check(MatAssemblyEnd(m->get(), MAT_FINAL_ASSEMBLY));
    }
    petsc_check(MatMatSolve(factor_.get(), b.get(), x.get()));
  }
  return X;
}

int Factor::solve_raw(const double* b, double* x) const {
  Vec in = nullptr, out = nullptr;
  int code = VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size_, b, &in);
  if (code == 0) code = VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size_, x, &out);
  if (code == 0) code = MatSolve(factor_.get(), in, out);
  VecDestroy(&in);
  VecDestroy(&out);
  return code;
}

Eigen::MatrixXd Factor::null_vectors() const {
  Eigen::MatrixXd N(size_, null_);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(size_);
  for (int k = 0; k < null_; ++k) {
    petsc_check(MatMumpsSetIcntl(factor_.get(), 25, k + 1));
    petsc_check(solve_raw(zero.data(), N.col(k).data()));
  }
  petsc_check(MatMumpsSetIcntl(factor_.get(), 25, 0));
  return N;
}

}  // namespace tisserand::reducer

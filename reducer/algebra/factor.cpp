// CHOLMOD first, MUMPS through PETSc's Cholesky interface where it does not do.
#include "reducer/algebra/factor.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <petscmat.h>

#include "common/error.hpp"

namespace tisserand::reducer {

Factor::Factor(const Matrix& A, const std::function<void(const FactorCost&)>& accept) : size_(A.size()) {
  constexpr double clearly_definite = 1e-12;
  auto definite = std::make_unique<Cholesky>(symmetric_rows(A));
  if (accept) accept(definite->cost());
  if (definite->factor() > clearly_definite) {
    cost_ = definite->cost();
    definite_ = std::move(definite);
    return;
  }
  definite.reset();
  factor_indefinite(A, 1e-14);
}

Factor Factor::indefinite(const Matrix& A, double null_pivot) {
  Factor factor;
  factor.size_ = A.size();
  factor.factor_indefinite(A, null_pivot);
  return factor;
}

void Factor::factor_indefinite(const Matrix& A, double null_pivot) {
  MatFactorInfo info;
  petsc_check(MatFactorInfoInitialize(&info));
  petsc_check(MatGetFactor(A.get(), MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, indefinite_.out()));
  petsc_check(MatMumpsSetIcntl(indefinite_.get(), 24, 1));         // null pivots are found, not fatal
  petsc_check(MatMumpsSetCntl(indefinite_.get(), 3, null_pivot));  // ... below this share of the scaled matrix's norm
  petsc_check(MatMumpsSetIcntl(indefinite_.get(), 14, 60));  // per cent of memory beyond the estimate, for pivoting
  petsc_check(MatCholeskyFactorSymbolic(indefinite_.get(), A.get(), nullptr, &info));
  petsc_check(MatCholeskyFactorNumeric(indefinite_.get(), A.get(), &info));
  MatFactorError failure = MAT_FACTOR_NOERROR;
  petsc_check(MatFactorGetError(indefinite_.get(), &failure));
  PetscInt null = 0, negative = 0, code = 0;
  petsc_check(MatMumpsGetInfog(indefinite_.get(), 1, &code));
  if (failure != MAT_FACTOR_NOERROR || code < 0)
    throw Error(fmt::format("MUMPS cannot factor a matrix of {} rows (INFOG(1) = {})", size_, code), "factorisation",
                failure == MAT_FACTOR_OUTMEMORY || code == -9 || code == -13
                    ? "the memory of this machine does not suffice: use fewer elements"
                    : "please report this with the part file");
  petsc_check(MatMumpsGetInfog(indefinite_.get(), 28, &null));
  petsc_check(MatMumpsGetInfog(indefinite_.get(), 12, &negative));
  null_ = null;
  negative_ = negative;
  PetscInt entries = 0;
  PetscReal operations = 0.0;
  petsc_check(MatMumpsGetInfog(indefinite_.get(), 20, &entries));
  petsc_check(MatMumpsGetRinfog(indefinite_.get(), 1, &operations));
  cost_ = {entries < 0 ? -1e6 * entries : static_cast<double>(entries), operations};
}

Eigen::MatrixXd Factor::solve(const Eigen::MatrixXd& B) const {
  return definite_ != nullptr ? definite_->solve(B) : solve_indefinite(B);
}

Eigen::MatrixXd Factor::solve_indefinite(const Eigen::MatrixXd& B) const {
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
    petsc_check(MatMatSolve(indefinite_.get(), b.get(), x.get()));
  }
  return X;
}

int Factor::solve_raw(const double* b, double* x) const {
  if (definite_ != nullptr) {
    Eigen::Map<Eigen::VectorXd>(x, size_) = definite_->solve(Eigen::Map<const Eigen::VectorXd>(b, size_));
    return 0;
  }
  Vec in = nullptr, out = nullptr;
  int code = VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size_, b, &in);
  if (code == 0) code = VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size_, x, &out);
  if (code == 0) code = MatSolve(indefinite_.get(), in, out);
  VecDestroy(&in);
  VecDestroy(&out);
  return code;
}

Eigen::MatrixXd Factor::null_vectors() const {
  Eigen::MatrixXd N(size_, null_);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(size_);
  for (int k = 0; k < null_; ++k) {
    petsc_check(MatMumpsSetIcntl(indefinite_.get(), 25, k + 1));
    petsc_check(solve_raw(zero.data(), N.col(k).data()));
  }
  petsc_check(MatMumpsSetIcntl(indefinite_.get(), 25, 0));
  return N;
}

}  // namespace tisserand::reducer

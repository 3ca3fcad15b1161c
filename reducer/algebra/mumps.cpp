// SPDX-License-Identifier: GPL-3.0-or-later
// MUMPS through PETSc's Cholesky interface.
#include "reducer/algebra/mumps.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <petscmat.h>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

double in_millions_if_negative(PetscInt count) { return count < 0 ? -1e6 * count : static_cast<double>(count); }

}  // namespace

Mumps::Mumps(const Matrix& A, double null_pivot) : rows_(A.size()) {
  PetscInt local = 0;
  petsc_check(MatGetLocalSize(A.get(), &local, nullptr));
  local_rows_ = local;
  MatFactorInfo info;
  petsc_check(MatFactorInfoInitialize(&info));
  // MUMPS finds null vectors only if one rank gives the right-hand sides. PETSc has this as an option only.
  petsc_check(PetscOptionsSetValue(nullptr, "-mat_mumps_icntl_20", "0"));
  petsc_check(MatGetFactor(A.get(), MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor_.out()));
  petsc_check(MatMumpsSetIcntl(factor_.get(), 24, 1));         // null pivots are found, not fatal
  petsc_check(MatMumpsSetCntl(factor_.get(), 3, null_pivot));  // ... if below this share of the scaled matrix's norm
  petsc_check(MatMumpsSetIcntl(factor_.get(), 14, 60));        // per cent of memory above the estimate, for pivoting
  petsc_check(MatMumpsSetIcntl(factor_.get(), 13, 1));         // no ScaLAPACK at the root: it does not count signs
  petsc_check(MatCholeskyFactorSymbolic(factor_.get(), A.get(), nullptr, &info));
  PetscInt entries = 0;
  PetscReal operations = 0.0;
  petsc_check(MatMumpsGetInfog(factor_.get(), 20, &entries));
  petsc_check(MatMumpsGetRinfog(factor_.get(), 1, &operations));
  cost_ = {in_millions_if_negative(entries), operations};
}

void Mumps::factor(const Matrix& A) {
  MatFactorInfo info;
  petsc_check(MatFactorInfoInitialize(&info));
  petsc_check(MatCholeskyFactorNumeric(factor_.get(), A.get(), &info));
  PetscInt null = 0, negative = 0, code = 0;
  petsc_check(MatMumpsGetInfog(factor_.get(), 1, &code));
  petsc_check(MatMumpsGetInfog(factor_.get(), 28, &null));
  petsc_check(MatMumpsGetInfog(factor_.get(), 12, &negative));
  failure_ = std::min<int>(code, 0);
  null_ = null;
  negative_ = negative;
}

void Mumps::require_factored() const {
  if (failure_ == 0) return;
  const bool memory = failure_ == -9 || failure_ == -13 || failure_ == -7 || failure_ == -5;
  throw Error(fmt::format("MUMPS cannot factor a matrix of {} rows (INFOG(1) = {})", rows_, failure_), "factorisation",
              memory ? "this machine has too little memory: use fewer elements, or a machine with more memory"
                     : "please report this with the part file");
}

Eigen::MatrixXd Mumps::solve(const Eigen::MatrixXd& B) const {
  constexpr Eigen::Index block = 32;
  Eigen::MatrixXd X(B.rows(), B.cols());
  for (Eigen::Index first = 0; first < B.cols(); first += block) {
    const Eigen::Index count = std::min(block, B.cols() - first);
    const Matrix b = dense_view(factor_.get(), count, B.data() + first * B.rows());
    const Matrix x = dense_view(factor_.get(), count, X.data() + first * B.rows());
    petsc_check(MatMatSolve(factor_.get(), b.get(), x.get()));
  }
  return X;
}

Eigen::VectorXd Mumps::null_vector(int k) const {
  Eigen::VectorXd x(local_rows_);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(local_rows_);
  const MPI_Comm ranks = PetscObjectComm(reinterpret_cast<PetscObject>(factor_.get()));
  Vec in = nullptr, out = nullptr;
  petsc_check(VecCreateMPIWithArray(ranks, 1, local_rows_, rows_, zero.data(), &in));
  petsc_check(VecCreateMPIWithArray(ranks, 1, local_rows_, rows_, x.data(), &out));
  petsc_check(MatMumpsSetIcntl(factor_.get(), 25, k + 1));
  petsc_check(MatSolve(factor_.get(), in, out));
  petsc_check(MatMumpsSetIcntl(factor_.get(), 25, 0));
  VecDestroy(&in);
  VecDestroy(&out);
  return x;
}

}  // namespace tisserand::reducer

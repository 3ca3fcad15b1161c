// Set-up of EPS with a shell preconditioner around the factor, and its pairs.
#include "reducer/modes/krylov_schur.hpp"

#include <exception>
#include <vector>

#include <slepceps.h>

namespace tisserand::reducer {
namespace {

PetscErrorCode apply_factor(PC preconditioner, Vec b, Vec x) {
  void* context = nullptr;
  PetscErrorCode code = PCShellGetContext(preconditioner, &context);
  const PetscScalar* in = nullptr;
  PetscScalar* out = nullptr;
  PetscInt n = 0;
  if (code == 0) code = VecGetSize(b, &n);
  if (code == 0) code = VecGetArrayRead(b, &in);
  if (code == 0) code = VecGetArrayWrite(x, &out);
  if (code != 0) return code;
  try {
    const InverseAt& inverse = *static_cast<const InverseAt*>(context);
    Eigen::Map<Eigen::VectorXd>(out, n) =
        inverse.times * inverse.factor.solve(Eigen::Map<const Eigen::VectorXd>(in, n));
  } catch (const std::exception&) {
    return PETSC_ERR_LIB;
  }
  code = VecRestoreArrayWrite(x, &out);
  return code == 0 ? VecRestoreArrayRead(b, &in) : code;
}

}  // namespace

KrylovSchur::KrylovSchur(const Matrix& A, const Matrix& B, const InverseAt& inverse)
    : inverse_(inverse), size_(A.size()) {
  petsc_check(EPSCreate(PETSC_COMM_SELF, &eps_));
  petsc_check(EPSSetOperators(eps_, A.get(), B.get()));
  petsc_check(EPSSetProblemType(eps_, EPS_GHEP));
  petsc_check(EPSSetType(eps_, EPSKRYLOVSCHUR));
  petsc_check(EPSSetTarget(eps_, inverse.target));
  petsc_check(EPSSetWhichEigenpairs(eps_, EPS_TARGET_MAGNITUDE));
  petsc_check(EPSSetTolerances(eps_, 1e-12, 500));
  ST transformation = nullptr;
  petsc_check(EPSGetST(eps_, &transformation));
  petsc_check(STSetType(transformation, STSINVERT));
  petsc_check(STSetMatMode(transformation, ST_MATMODE_SHELL));
  KSP solver = nullptr;
  petsc_check(STGetKSP(transformation, &solver));
  petsc_check(KSPSetType(solver, KSPPREONLY));
  PC preconditioner = nullptr;
  petsc_check(KSPGetPC(solver, &preconditioner));
  petsc_check(PCSetType(preconditioner, PCSHELL));
  petsc_check(PCShellSetContext(preconditioner, &inverse_));
  petsc_check(PCShellSetApply(preconditioner, apply_factor));
}

KrylovSchur::~KrylovSchur() { EPSDestroy(&eps_); }

void KrylovSchur::deflate(const Eigen::MatrixXd& known) {
  std::vector<Vec> vectors(static_cast<std::size_t>(known.cols()));
  for (Eigen::Index k = 0; k < known.cols(); ++k)
    petsc_check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(known.rows()), known.col(k).data(),
                                      &vectors[static_cast<std::size_t>(k)]));
  petsc_check(EPSSetDeflationSpace(eps_, static_cast<PetscInt>(known.cols()), vectors.data()));
  for (Vec& v : vectors) VecDestroy(&v);
}

EigenPairs KrylovSchur::solve(int count) {
  petsc_check(EPSSetDimensions(eps_, count, PETSC_DEFAULT, PETSC_DEFAULT));
  petsc_check(EPSSolve(eps_));
  PetscInt converged = 0;
  petsc_check(EPSGetConverged(eps_, &converged));
  EigenPairs pairs{Eigen::VectorXd(converged), Eigen::MatrixXd(size_, converged)};
  for (PetscInt k = 0; k < converged; ++k) {
    Vec x = nullptr;
    petsc_check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size_, pairs.vector.col(k).data(), &x));
    petsc_check(EPSGetEigenpair(eps_, k, &pairs.value[k], nullptr, x, nullptr));
    VecDestroy(&x);
  }
  return pairs;
}

}  // namespace tisserand::reducer

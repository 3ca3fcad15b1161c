// SPDX-License-Identifier: GPL-3.0-or-later
// Set-up of EPS with a shell matrix around the factor, and its pairs.
#include "reducer/modes/eps.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <slepceps.h>

#include "reducer/modes/eps_block_lanczos.hpp"

namespace tisserand::reducer {
namespace {

/// Tolerance, a tenth of the permitted residual of modes. One step of inverse iteration follows, which need not lower
/// it, and measures it in another norm.
constexpr double block_tolerance = 1e-9;
constexpr int most_blocks = 1000;
constexpr double krylov_tolerance = 1e-12;
constexpr int most_restarts = 500;

}  // namespace

const char* eps_type(EigenSolver solver) {
  switch (solver) {
    case EigenSolver::lapack:
      return EPSLAPACK;
    case EigenSolver::block_lanczos:
      return eps_block_lanczos;
    case EigenSolver::krylov_schur:
      return EPSKRYLOVSCHUR;
  }
  return "";
}

std::string slepc_version() {
  PetscInt major = 0, minor = 0, subminor = 0;
  petsc_check(SlepcGetVersionNumber(&major, &minor, &subminor, nullptr));
  return fmt::format("SLEPc {}.{}.{}", major, minor, subminor);
}

/// Functions that SLEPc calls. They throw no exceptions: `failure_` keeps one until EPSSolve returns.
struct Eps::Calls {
  static Eps& owner(PC preconditioner) {
    void* context = nullptr;
    petsc_check(PCShellGetContext(preconditioner, &context));
    return *static_cast<Eps*>(context);
  }

  template <class Work>
  static PetscErrorCode guarded(Eps& eps, const Work& work) {
    try {
      work();
      return 0;
    } catch (...) {
      if (!eps.failure_) eps.failure_ = std::current_exception();
      return PETSC_ERR_LIB;
    }
  }

  static Eigen::MatrixXd solution(Eps& eps, const Eigen::MatrixXd& X) {
    eps.columns_ += static_cast<int>(X.cols());
    eps.tell(std::min(eps.columns_ / (3.0 * eps.wanted_ + 60.0), 0.95));
    return eps.inverse_.solve(X);
  }

  static PetscErrorCode apply(PC preconditioner, Vec b, Vec x) {
    Eps& eps = owner(preconditioner);
    return guarded(eps, [&] {
      const PetscScalar* in = nullptr;
      PetscScalar* out = nullptr;
      petsc_check(VecGetArrayRead(b, &in));
      petsc_check(VecGetArrayWrite(x, &out));
      Eigen::Map<Eigen::VectorXd>(out, eps.rows_) = solution(eps, Eigen::Map<const Eigen::VectorXd>(in, eps.rows_));
      petsc_check(VecRestoreArrayWrite(x, &out));
      petsc_check(VecRestoreArrayRead(b, &in));
    });
  }

  static PetscErrorCode apply_to_block(PC preconditioner, Mat B, Mat X) {
    Eps& eps = owner(preconditioner);
    return guarded(eps, [&] {
      const PetscScalar* in = nullptr;
      PetscScalar* out = nullptr;
      PetscInt columns = 0, in_stride = 0, out_stride = 0;
      petsc_check(MatGetSize(B, nullptr, &columns));
      petsc_check(MatDenseGetLDA(B, &in_stride));
      petsc_check(MatDenseGetLDA(X, &out_stride));
      petsc_check(MatDenseGetArrayRead(B, &in));
      petsc_check(MatDenseGetArrayWrite(X, &out));
      using Stride = Eigen::OuterStride<>;
      Eigen::Map<Eigen::MatrixXd, 0, Stride>(out, eps.rows_, columns, Stride(out_stride)) =
          solution(eps, Eigen::Map<const Eigen::MatrixXd, 0, Stride>(in, eps.rows_, columns, Stride(in_stride)));
      petsc_check(MatDenseRestoreArrayWrite(X, &out));
      petsc_check(MatDenseRestoreArrayRead(B, &in));
    });
  }

  /// Pairs converge late, so at first the columns measure the progress: usually three per pair and 60 are needed.
  static PetscErrorCode monitor(EPS, PetscInt, PetscInt converged, PetscScalar*, PetscScalar*, PetscReal*, PetscInt,
                                void* context) {
    Eps& eps = *static_cast<Eps*>(context);
    return guarded(eps, [&] { eps.tell(static_cast<double>(converged) / eps.wanted_); });
  }
};

void Eps::tell(double done) {
  done_ = std::clamp(done, done_, 1.0);
  share_(done_);
}

void Eps::create(const Matrix& A, const Matrix& B) {
  PetscInt rows = 0;
  petsc_check(MatGetLocalSize(A.get(), &rows, nullptr));
  rows_ = rows;
  register_block_lanczos();
  petsc_check(EPSCreate(PetscObjectComm(reinterpret_cast<PetscObject>(A.get())), &eps_));
  petsc_check(EPSSetOperators(eps_, A.get(), B.get()));
  petsc_check(EPSSetProblemType(eps_, EPS_GHEP));
  petsc_check(EPSMonitorSet(eps_, Calls::monitor, this, nullptr));
}

Eps::Eps(const Matrix& A, const Matrix& B) {
  create(A, B);
  petsc_check(EPSSetWhichEigenpairs(eps_, EPS_LARGEST_REAL));
}

Eps::Eps(const Matrix& A, const Matrix& B, ShiftInvert inverse) : inverse_(std::move(inverse)) {
  create(A, B);
  petsc_check(EPSSetTarget(eps_, inverse_.target));
  petsc_check(EPSSetWhichEigenpairs(eps_, EPS_TARGET_MAGNITUDE));
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
  petsc_check(PCShellSetContext(preconditioner, this));
  petsc_check(PCShellSetApply(preconditioner, Calls::apply));
  petsc_check(PCShellSetMatApply(preconditioner, Calls::apply_to_block));
}

Eps::~Eps() { EPSDestroy(&eps_); }

void Eps::deflate(const Eigen::MatrixXd& known) {
  Mat A = nullptr;
  petsc_check(EPSGetOperators(eps_, &A, nullptr));
  std::vector<Vec> vectors(static_cast<std::size_t>(known.cols()));
  for (Eigen::Index k = 0; k < known.cols(); ++k) {
    Vec& v = vectors[k];
    petsc_check(MatCreateVecs(A, nullptr, &v));
    petsc_check(VecPlaceArray(v, known.col(k).data()));
  }
  petsc_check(EPSSetDeflationSpace(eps_, static_cast<PetscInt>(known.cols()), vectors.data()));
  for (Vec& v : vectors) VecDestroy(&v);  // EPS holds references until EPSSetUp copies them
  petsc_check(EPSSetUp(eps_));
  // SLEPc takes motions softer than 1.5e-7, in any units, for a null space of A − target B, and the linear solver would
  // omit them.
  ST transformation = nullptr;
  KSP solver = nullptr;
  Mat shifted = nullptr;
  petsc_check(EPSGetST(eps_, &transformation));
  petsc_check(STGetKSP(transformation, &solver));
  petsc_check(KSPGetOperators(solver, &shifted, nullptr));
  petsc_check(MatSetNullSpace(shifted, nullptr));
}

bool Eps::solve(EigenSolver type, int count, const Eigen::MatrixXd& known) {
  const bool in_blocks = type == EigenSolver::block_lanczos;
  wanted_ = count;
  columns_ = 0;
  done_ = 0.0;
  failure_ = nullptr;
  petsc_check(EPSSetType(eps_, eps_type(type)));
  petsc_check(EPSSetPurify(eps_, in_blocks || inverse_.purify ? PETSC_TRUE : PETSC_FALSE));
  petsc_check(
      EPSSetTolerances(eps_, in_blocks ? block_tolerance : krylov_tolerance, in_blocks ? most_blocks : most_restarts));
  petsc_check(EPSSetDimensions(eps_, count, PETSC_DEFAULT, PETSC_DEFAULT));
  if (known.cols() > 0) deflate(known);
  const PetscErrorCode code = EPSSolve(eps_);
  if (failure_) std::rethrow_exception(failure_);
  if (const std::exception_ptr failure = block_lanczos_failure(eps_)) std::rethrow_exception(failure);
  petsc_check(code);
  EPSConvergedReason reason = EPS_CONVERGED_ITERATING;
  petsc_check(EPSGetConvergedReason(eps_, &reason));
  return reason > 0;
}

EigenPairs Eps::pairs(int most) const {
  PetscInt converged = 0;
  petsc_check(EPSGetConverged(eps_, &converged));
  const PetscInt count = std::min<PetscInt>(converged, most);
  EigenPairs pairs{Eigen::VectorXd(count), Eigen::MatrixXd(rows_, count)};
  Mat A = nullptr;
  Vec x = nullptr;
  petsc_check(EPSGetOperators(eps_, &A, nullptr));
  petsc_check(MatCreateVecs(A, nullptr, &x));
  for (PetscInt k = 0; k < count; ++k) {
    petsc_check(VecPlaceArray(x, pairs.vector.col(k).data()));
    petsc_check(EPSGetEigenpair(eps_, k, &pairs.value[k], nullptr, x, nullptr));
    petsc_check(VecResetArray(x));
  }
  VecDestroy(&x);
  return pairs;
}

Eigen::VectorXd Eps::residuals() const {
  PetscInt converged = 0;
  petsc_check(EPSGetConverged(eps_, &converged));
  Eigen::VectorXd residual(converged);
  for (PetscInt k = 0; k < converged; ++k) petsc_check(EPSGetErrorEstimate(eps_, k, &residual[k]));
  return residual;
}

int Eps::iterations() const {
  PetscInt count = 0;
  petsc_check(EPSGetIterationNumber(eps_, &count));
  return count;
}

}  // namespace tisserand::reducer

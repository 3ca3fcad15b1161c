// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of the EPS type that SLEPc calls. Only this file includes SLEPc's private header, as its manual prescribes
// for new solvers.
#include "reducer/modes/eps_block_lanczos.hpp"

#ifndef TISSERAND_EPS_TYPES

namespace tisserand::reducer {

bool has_block_lanczos() { return false; }
void register_block_lanczos() {}
std::exception_ptr block_lanczos_failure(_p_EPS*) { return nullptr; }

}  // namespace tisserand::reducer

#else

#include <algorithm>

#include <slepc/private/epsimpl.h>

#include "reducer/algebra/petsc.hpp"
#include "reducer/algebra/ranks.hpp"
#include "reducer/modes/block_lanczos.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Data of the solver in eps->data.
struct BlockLanczosData {
  PetscInt block = 0;  ///< 0: chosen by the number of pairs
  VectorXd lambda;     ///< eigenvalues of the pairs found
  std::exception_ptr failure;
};

BlockLanczosData& data_of(EPS eps) { return *static_cast<BlockLanczosData*>(eps->data); }

PetscErrorCode set_up(EPS eps) {
  PetscFunctionBegin;
  EPSCheckHermitianDefinite(eps);
  EPSCheckSinvert(eps);
  EPSCheckUnsupported(eps, EPS_FEATURE_BALANCE | EPS_FEATURE_ARBITRARY | EPS_FEATURE_REGION | EPS_FEATURE_EXTRACTION |
                               EPS_FEATURE_TWOSIDED);
  if (!eps->which) eps->which = EPS_TARGET_MAGNITUDE;
  PetscCheck(eps->which == EPS_TARGET_MAGNITUDE || eps->which == EPS_TARGET_REAL, PetscObjectComm((PetscObject)eps),
             PETSC_ERR_SUP, "The solver 'block_lanczos' finds the eigenvalues above a target below the spectrum");
  BlockLanczosData& data = data_of(eps);
  const PetscInt block = data.block > 0 ? data.block : lanczos_block(eps->nev);
  if (eps->ncv < 1) eps->ncv = std::min<PetscInt>(lanczos_columns(eps->nev, block), eps->n);
  eps->mpd = eps->ncv;
  if (eps->max_it < 1) eps->max_it = 1000;
  PetscCall(EPSAllocateSolution(eps, 0));
  PetscCall(EPS_SetInnerProduct(eps));
  PetscFunctionReturn(0);
}

/// Sets ascending order of eigenvalues: nearest to the target first.
PetscErrorCode set_up_sorting(EPS eps) {
  eps->sc->comparison = SlepcCompareTargetMagnitude;
  eps->sc->comparisonctx = &eps->target;
  eps->sc->map = nullptr;
  eps->sc->mapobj = nullptr;
  return 0;
}

/// B X: by our own product for a symmetric matrix of this process, otherwise column by column.
MatrixXd product(Mat B, const MatrixXd& X) {
  if (B == nullptr) return X;
  PetscBool own = PETSC_FALSE;
  petsc_check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(B), MATSEQSBAIJ, &own));
  petsc_check(PetscObjectReference(reinterpret_cast<PetscObject>(B)));
  const Matrix held(B);
  return own ? multiply(held, X) : multiply_rows(held, X);
}

ShiftedOperator operator_of(EPS eps) {
  ShiftedOperator op;
  PetscInt matrices = 0, first = 0;
  Mat A = nullptr, B = nullptr;
  petsc_check(STGetShift(eps->st, &op.shift));
  petsc_check(STGetNumMatrices(eps->st, &matrices));
  petsc_check(STGetMatrix(eps->st, 0, &A));
  if (matrices > 1) petsc_check(STGetMatrix(eps->st, 1, &B));
  petsc_check(MatGetOwnershipRange(A, &first, nullptr));
  op.size = eps->n;
  op.first = first;
  op.rows = eps->nloc;
  op.shared = op.rows < op.size;
  op.mass = [B](const MatrixXd& X) { return product(B, X); };
  op.solve = [eps, A](const MatrixXd& X) {
    MatrixXd Y(X.rows(), X.cols());
    const Matrix from = dense_view(A, X.cols(), X.data()), to = dense_view(A, Y.cols(), Y.data());
    petsc_check(STMatMatSolve(eps->st, from.get(), to.get()));
    return Y;
  };
  return op;
}

VectorXd error_estimates(EPS eps, const VectorXd& mu, const VectorXd& residual) {
  VectorXd error(mu.size());
  for (Index k = 0; k < mu.size(); ++k)
    petsc_check((*eps->converged)(eps, mu[k], 0.0, residual[k], &error[k], eps->convergedctx));
  return error;
}

/// Runs the stopping test, then the monitors. A target inside the spectrum shows by Ritz values of both signs.
bool ends(EPS eps, int steps, int converged, const VectorXd& mu, const VectorXd& error) {
  constexpr double negative = 1e-8;
  eps->its = steps;
  eps->nconv = converged;
  const Index shown = std::min<Index>(mu.size(), eps->ncv);
  std::copy_n(mu.data(), shown, eps->eigr);
  std::copy_n(error.data(), shown, eps->errest);
  petsc_check((*eps->stopping)(eps, steps, eps->max_it, converged, eps->nev, &eps->reason, eps->stoppingctx));
  petsc_check(EPSMonitor(eps, steps, converged, eps->eigr, eps->eigi, eps->errest, static_cast<PetscInt>(shown)));
  if (mu.minCoeff() < -negative * mu.cwiseAbs().maxCoeff()) eps->reason = EPS_DIVERGED_BREAKDOWN;
  return eps->reason != EPS_CONVERGED_ITERATING;
}

/// Removes the share of the constraints D from X and makes X orthonormal.
void leave_constraints(const ShiftedOperator& op, const Eigen::Ref<const MatrixXd>& D, Eigen::Ref<MatrixXd> X) {
  const auto products = [&op](const Eigen::Ref<const MatrixXd>& A, const MatrixXd& B) {
    MatrixXd C = A.transpose() * B;
    op.sum(C.data(), C.size());
    return C;
  };
  X -= D * products(D, op.mass(X));
  orthonormalise(op, products(X, op.mass(X)), X);
}

void iterate(EPS eps) {
  const ShiftedOperator op = operator_of(eps);
  BlockLanczosData& data = data_of(eps);
  PetscScalar* array = nullptr;
  petsc_check(BVGetArray(eps->V, &array));  // constraints first, no gaps between columns
  const int constraints = eps->nds, block = data.block > 0 ? data.block : lanczos_block(eps->nev);
  Eigen::Map<MatrixXd> columns(array, op.rows, constraints + eps->ncv);
  const LanczosControl control{
      eps->nev,
      block,
      eps->tol,
      eps->max_it,
      [eps](const VectorXd& mu, const VectorXd& residual) { return error_estimates(eps, mu, residual); },
      [eps](int steps, int converged, const VectorXd& mu, const VectorXd& error) {
        return ends(eps, steps, converged, mu, error);
      }};
  const LanczosPairs found = block_lanczos(op, control, {columns, constraints, eps->nini});
  eps->its = found.steps;
  data.lambda = op.shift + found.mu.array().inverse();
  if (found.broke_down) eps->reason = EPS_DIVERGED_BREAKDOWN;
  if (eps->purify && data.lambda.size() > 0) {
    auto X = columns.middleCols(constraints, data.lambda.size());
    const VectorXd residual = iterate_once(op, data.lambda, X);
    std::copy_n(residual.data(), residual.size(), eps->errest);
    if (constraints > 0) leave_constraints(op, columns.leftCols(constraints), X.leftCols(data.lambda.size()));
  }
  eps->nconv = static_cast<PetscInt>(data.lambda.size());
  for (Index k = 0; k < data.lambda.size(); ++k) eps->eigr[k] = 1.0 / (data.lambda[k] - op.shift);
  petsc_check(BVRestoreArray(eps->V, &array));
}

/// Solves the problem. It throws no exception: block_lanczos_failure() returns it.
PetscErrorCode solve(EPS eps) {
  data_of(eps).failure = nullptr;
  try {
    iterate(eps);
    return 0;
  } catch (...) {
    data_of(eps).failure = std::current_exception();
    return PETSC_ERR_LIB;
  }
}

/// Returns the eigenvalues as found, since 1/(1/(λ − shift)) + shift would round them.
PetscErrorCode back_transform(EPS eps) {
  const VectorXd& lambda = data_of(eps).lambda;
  std::copy_n(lambda.data(), std::min<Index>(lambda.size(), eps->nconv), eps->eigr);
  return 0;
}

/// Reads the options, whose type differs between releases of PETSc.
template <class Options>
PetscErrorCode set_from_options(EPS eps, Options PetscOptionsObject) {
  PetscFunctionBegin;
  PetscOptionsHeadBegin(PetscOptionsObject, "EPS block Lanczos Options");
  PetscCall(PetscOptionsInt("-eps_block_lanczos_size", "Columns of a block", "", data_of(eps).block,
                            &data_of(eps).block, nullptr));
  PetscOptionsHeadEnd();
  PetscFunctionReturn(0);
}

PetscErrorCode view(EPS eps, PetscViewer viewer) {
  const PetscInt block = data_of(eps).block > 0 ? data_of(eps).block : lanczos_block(eps->nev);
  return PetscViewerASCIIPrintf(viewer, "  columns of a block: %d\n", static_cast<int>(block));
}

PetscErrorCode destroy(EPS eps) {
  delete static_cast<BlockLanczosData*>(eps->data);
  eps->data = nullptr;
  return 0;
}

PetscErrorCode create(EPS eps) {
  eps->data = new BlockLanczosData;
  eps->useds = PETSC_FALSE;
  eps->categ = EPS_CATEGORY_KRYLOV;
  eps->ops->setup = set_up;
  eps->ops->setupsort = set_up_sorting;
  eps->ops->solve = solve;
  eps->ops->backtransform = back_transform;
  eps->ops->setfromoptions = set_from_options;
  eps->ops->view = view;
  eps->ops->destroy = destroy;
  return 0;
}

}  // namespace

bool has_block_lanczos() { return true; }

void register_block_lanczos() { petsc_check(EPSRegister(eps_block_lanczos, create)); }

std::exception_ptr block_lanczos_failure(EPS eps) { return eps->ops->solve == solve ? data_of(eps).failure : nullptr; }

}  // namespace tisserand::reducer

#endif

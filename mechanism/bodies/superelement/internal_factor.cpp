// Cholesky where it exists, else LU.
#include "mechanism/bodies/superelement/internal_factor.hpp"

namespace tisserand::mechanism {

using Eigen::MatrixXd;

// A factor of something: an empty one is not all initialised, and copies read all of it.
InternalFactor::InternalFactor() : cholesky_(MatrixXd(0, 0)) {}

void InternalFactor::resize(Eigen::Index modes) {
  cholesky_.compute(MatrixXd::Identity(modes, modes));
  lu_ = Eigen::PartialPivLU<MatrixXd>(modes);
}

void InternalFactor::factor_symmetric(const Eigen::Ref<const MatrixXd>& A) {
  cholesky_.compute(A);
  definite_ = cholesky_.info() == Eigen::Success;
  if (!definite_) lu_.compute(A.selfadjointView<Eigen::Lower>());
}

void InternalFactor::factor(const Eigen::Ref<const MatrixXd>& A) {
  lu_.compute(A);
  definite_ = false;
}

void InternalFactor::solve_in_place(Eigen::VectorXd& x) const {
  if (definite_)
    cholesky_.solveInPlace(x);
  else
    x = lu_.solve(x).eval();
}

void InternalFactor::solve_in_place(MatrixXd& X) const {
  if (definite_)
    cholesky_.solveInPlace(X);
  else
    X = lu_.solve(X).eval();
}

void InternalFactor::subtract_schur(MatrixXd& B, MatrixXd& S) const {
  if (definite_) {
    cholesky_.matrixL().solveInPlace(B);
    S.selfadjointView<Eigen::Lower>().rankUpdate(B.transpose(), -1.0);
  } else {
    S -= B.transpose() * lu_.solve(B).eval();
  }
}

}  // namespace tisserand::mechanism

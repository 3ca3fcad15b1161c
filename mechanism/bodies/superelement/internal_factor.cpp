// Cholesky where it exists, else LU.
#include "mechanism/bodies/superelement/internal_factor.hpp"

namespace tisserand::mechanism {

void InternalFactor::resize(Eigen::Index modes) {
  cholesky_ = Eigen::LLT<Eigen::MatrixXd>(modes);
  lu_ = Eigen::PartialPivLU<Eigen::MatrixXd>(modes);
}

void InternalFactor::factor_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& A) {
  cholesky_.compute(A);
  definite_ = cholesky_.info() == Eigen::Success;
  if (!definite_) lu_.compute(A.selfadjointView<Eigen::Lower>());
}

void InternalFactor::factor(const Eigen::Ref<const Eigen::MatrixXd>& A) {
  lu_.compute(A);
  definite_ = false;
}

void InternalFactor::solve_in_place(Eigen::VectorXd& x) const {
  if (definite_)
    cholesky_.solveInPlace(x);
  else
    x = lu_.solve(x).eval();
}

void InternalFactor::solve_in_place(Eigen::MatrixXd& X) const {
  if (definite_)
    cholesky_.solveInPlace(X);
  else
    X = lu_.solve(X).eval();
}

void InternalFactor::subtract_schur(Eigen::MatrixXd& B, Eigen::MatrixXd& S) const {
  if (definite_) {
    cholesky_.matrixL().solveInPlace(B);
    S.selfadjointView<Eigen::Lower>().rankUpdate(B.transpose(), -1.0);
  } else {
    S -= B.transpose() * lu_.solve(B).eval();
  }
}

}  // namespace tisserand::mechanism

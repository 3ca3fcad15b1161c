// SPDX-License-Identifier: GPL-3.0-or-later
// Factors by Cholesky if the matrix is positive definite, else by LU.
#include "mechanism/bodies/superelement/tangent/internal_factor.hpp"

namespace tisserand::mechanism {

using Eigen::MatrixXd;

// Starts with the factor of a matrix: copies read all of it, and an empty factor is not fully initialised.
InternalFactor::InternalFactor() : cholesky_(MatrixXd(0, 0)) {}

void InternalFactor::resize(Eigen::Index modes) {
  cholesky_.compute(MatrixXd::Identity(modes, modes));
  lu_ = Eigen::PartialPivLU<MatrixXd>(modes);
}

void InternalFactor::set_diagonal(const Eigen::VectorXd& A) {
  kind_ = Kind::diagonal;
  reciprocals_ = A.cwiseInverse();
}

void InternalFactor::factor_symmetric(const Eigen::Ref<const MatrixXd>& A) {
  cholesky_.compute(A);
  kind_ = cholesky_.info() == Eigen::Success ? Kind::cholesky : Kind::lu;
  if (kind_ == Kind::lu) lu_.compute(A.selfadjointView<Eigen::Lower>());
}

void InternalFactor::factor(const Eigen::Ref<const MatrixXd>& A) {
  lu_.compute(A);
  kind_ = Kind::lu;
}

void InternalFactor::solve_in_place(Eigen::VectorXd& x) const {
  if (kind_ == Kind::diagonal)
    x.array() *= reciprocals_.array();
  else if (kind_ == Kind::cholesky)
    cholesky_.solveInPlace(x);
  else
    x = lu_.solve(x).eval();
}

void InternalFactor::solve_in_place(MatrixXd& X) const {
  if (kind_ == Kind::diagonal)
    X.array().colwise() *= reciprocals_.array();
  else if (kind_ == Kind::cholesky)
    cholesky_.solveInPlace(X);
  else
    X = lu_.solve(X).eval();
}

void InternalFactor::subtract_schur(MatrixXd& B, MatrixXd& S) const {
  if (kind_ == Kind::cholesky) {
    cholesky_.matrixL().solveInPlace(B);
    S.selfadjointView<Eigen::Lower>().rankUpdate(B.transpose(), -1.0);
  } else {
    S -= B.transpose() * lu_.solve(B).eval();
  }
}

}  // namespace tisserand::mechanism

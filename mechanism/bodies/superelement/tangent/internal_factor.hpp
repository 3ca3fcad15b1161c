// SPDX-License-Identifier: GPL-3.0-or-later
// Factorisation of the internal block of a superelement's tangent.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace tisserand::mechanism {

/// Factors of the internal block A_II of a tangent: reciprocals of a diagonal, Cholesky factors, or LU factors if A_II
/// is not positive definite. LU is needed beyond a buckling load of the body with its boundary held, and for an exact
/// tangent.
class InternalFactor {
 public:
  InternalFactor();
  /// Allocates the memory for later factorisations.
  void resize(Eigen::Index modes);

  void set_diagonal(const Eigen::VectorXd& A);
  /// Factors a symmetric A, of which the lower triangle is read.
  void factor_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& A);
  void factor(const Eigen::Ref<const Eigen::MatrixXd>& A);

  /// Replaces x by A⁻¹ x.
  void solve_in_place(Eigen::VectorXd& x) const;
  void solve_in_place(Eigen::MatrixXd& X) const;

  /// Reciprocals 1/A of a diagonal matrix A.
  const Eigen::VectorXd& reciprocals() const { return reciprocals_; }

  /// Subtracts Bᵀ A⁻¹ B from the lower triangle of S, for a symmetric factored A. Overwrites B (modes x columns of S).
  void subtract_schur(Eigen::MatrixXd& B, Eigen::MatrixXd& S) const;

 private:
  enum class Kind { diagonal, cholesky, lu } kind_ = Kind::diagonal;
  Eigen::VectorXd reciprocals_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

}  // namespace tisserand::mechanism

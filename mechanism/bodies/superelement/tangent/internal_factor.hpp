// Factors of the internal block of a superelement's tangent.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace tisserand::mechanism {

/// A_II: a diagonal, a matrix by Cholesky, or one by LU where it is not positive definite: beyond a buckling load of
/// the body with its boundary held, or of an exact tangent.
class InternalFactor {
 public:
  InternalFactor();
  /// Takes the memory that factors of matrices need later.
  void resize(Eigen::Index modes);

  void set_diagonal(const Eigen::VectorXd& A);
  /// A: its lower triangle counts.
  void factor_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& A);
  void factor(const Eigen::Ref<const Eigen::MatrixXd>& A);

  /// x ← A⁻¹ x.
  void solve_in_place(Eigen::VectorXd& x) const;
  void solve_in_place(Eigen::MatrixXd& X) const;

  /// 1/A of a diagonal matrix A.
  const Eigen::VectorXd& reciprocals() const { return reciprocals_; }

  /// Lower triangle of S −= Bᵀ A⁻¹ B of a symmetric matrix A; B (modes x columns) is lost.
  void subtract_schur(Eigen::MatrixXd& B, Eigen::MatrixXd& S) const;

 private:
  enum class Kind { diagonal, cholesky, lu } kind_ = Kind::diagonal;
  Eigen::VectorXd reciprocals_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

}  // namespace tisserand::mechanism

// Factors of the internal block of a superelement's tangent where it is dense and changes.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace tisserand::mechanism {

/// A_II by Cholesky, or by LU where it is not positive definite: beyond a buckling load of the body with its boundary
/// held, or of an exact tangent.
class InternalFactor {
 public:
  InternalFactor();
  void resize(Eigen::Index modes);

  /// A: its lower triangle counts.
  void factor_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& A);
  void factor(const Eigen::Ref<const Eigen::MatrixXd>& A);

  /// x ← A⁻¹ x.
  void solve_in_place(Eigen::VectorXd& x) const;
  void solve_in_place(Eigen::MatrixXd& X) const;

  /// Lower triangle of S −= Bᵀ A⁻¹ B of the symmetric A; B (modes x columns) is lost.
  void subtract_schur(Eigen::MatrixXd& B, Eigen::MatrixXd& S) const;

 private:
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  bool definite_ = false;
};

}  // namespace tisserand::mechanism

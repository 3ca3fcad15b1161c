// Factors of the internal block of a superelement's tangent where it is dense and changes.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace tisserand::mechanism {

/// A_II by Cholesky, or by LU where it is not positive definite: beyond a buckling load of the body with its boundary
/// held, or of an exact tangent.
class InternalFactor {
 public:
  void resize(Eigen::Index modes) {
    cholesky_ = Eigen::LLT<Eigen::MatrixXd>(modes);
    lu_ = Eigen::PartialPivLU<Eigen::MatrixXd>(modes);
  }

  /// A: its lower triangle counts.
  void factor_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& A) {
    cholesky_.compute(A);
    definite_ = cholesky_.info() == Eigen::Success;
    if (!definite_) lu_.compute(A.selfadjointView<Eigen::Lower>());
  }

  void factor(const Eigen::Ref<const Eigen::MatrixXd>& A) {
    lu_.compute(A);
    definite_ = false;
  }

  /// x ← A⁻¹ x.
  template <class Matrix>
  void solve_in_place(Matrix& x) const {
    if (definite_)
      cholesky_.solveInPlace(x);
    else
      x = lu_.solve(x).eval();
  }

  /// Lower triangle of S −= Bᵀ A⁻¹ B of the symmetric A; B (modes x columns) is lost.
  void subtract_schur(Eigen::MatrixXd& B, Eigen::MatrixXd& S) const {
    if (definite_) {
      cholesky_.matrixL().solveInPlace(B);
      S.selfadjointView<Eigen::Lower>().rankUpdate(B.transpose(), -1.0);
    } else {
      S -= B.transpose() * lu_.solve(B).eval();
    }
  }

 private:
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  bool definite_ = false;
};

}  // namespace tisserand::mechanism

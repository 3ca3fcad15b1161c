// L D Lᵀ of a sparse symmetric matrix by MUMPS through PETSc, which counts signs and finds null vectors; of one
// process, or of all ranks together.
#pragma once

#include <Eigen/Core>

#include "reducer/algebra/cholesky.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// Of a matrix that lies on several ranks all members are collective, and rows are those of the rank.
class Mumps {
 public:
  /// The order of elimination. Pivots below `null_pivot` of the largest (after scaling) will count as null.
  Mumps(const Matrix& A, double null_pivot);
  /// By MUMPS's own estimate.
  const FactorCost& cost() const { return cost_; }
  int rows() const { return rows_; }  ///< of the whole matrix

  /// A as before. What fails, such as the memory, fails on all ranks alike, and is told by require_factored().
  void factor(const Matrix& A);
  /// Throws Error with the reason and the remedy if factor() failed.
  void require_factored() const;
  /// Eigenvalues of A by sign (Sylvester's law of inertia).
  int negative() const { return negative_; }
  int null() const { return null_; }

  /// A⁻¹ B. Only if null() is 0.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// Number k of a basis of the null space, k < null().
  Eigen::VectorXd null_vector(int k) const;

 private:
  Matrix factor_;
  FactorCost cost_;
  int rows_ = 0;
  int local_rows_ = 0;  ///< of this rank
  int negative_ = 0;
  int null_ = 0;
  int failure_ = 0;  ///< MUMPS's INFOG(1), if negative
};

}  // namespace tisserand::reducer

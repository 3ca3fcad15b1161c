// Factorisation L D Lᵀ of a sparse symmetric matrix (MUMPS through PETSc): solve blocks, count signs, find null
// vectors.
#pragma once

#include <Eigen/Core>

#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// Owns the factor; `negative` and `null` are counts of eigenvalues of the matrix by sign (Sylvester's law of inertia).
class Factor {
 public:
  Factor() = default;  ///< of a matrix without rows
  /// Factors A; pivots below 1e-14 of the largest (after scaling) count as null and do not fail.
  explicit Factor(const Matrix& A) : Factor(A, 1e-14) {}
  Factor(const Matrix& A, double null_pivot);

  int negative() const { return negative_; }
  int null() const { return null_; }

  /// A⁻¹ B, 32 columns at a time. Only if null() is 0.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// A⁻¹ b for raw arrays of n values; returns a PETSc error code, for callbacks.
  int solve_raw(const double* b, double* x) const;
  /// A basis of the null space (n x null()).
  Eigen::MatrixXd null_vectors() const;

 private:
  Matrix factor_;
  int size_ = 0;
  int negative_ = 0;
  int null_ = 0;
};

}  // namespace tisserand::reducer

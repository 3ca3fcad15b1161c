// SPDX-License-Identifier: GPL-3.0-or-later
// Factor L D Lᵀ of a sparse symmetric matrix by MUMPS through PETSc. It counts signs and finds null vectors, in one
// process or in all ranks together.
#pragma once

#include <Eigen/Core>

#include "reducer/algebra/cholesky.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// Factor of a matrix. If it is spread over several ranks, all members are collective and work on the rank's rows.
class Mumps {
 public:
  /// Finds the elimination order. Pivots below `null_pivot` of the largest (after scaling) will count as null.
  Mumps(const Matrix& A, double null_pivot);
  /// Cost as MUMPS estimates it.
  const FactorCost& cost() const { return cost_; }
  int rows() const { return rows_; }  ///< rows of the whole matrix

  /// Factors the constructor's A. A failure (such as short memory) occurs on all ranks; see require_factored().
  void factor(const Matrix& A);
  /// Throws Error with reason and remedy if factor() failed.
  void require_factored() const;
  /// Number of negative eigenvalues of A (Sylvester's law of inertia).
  int negative() const { return negative_; }
  int null() const { return null_; }

  /// Solution A⁻¹ B. Only if null() is 0.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// Vector k of a basis of the null space, k < null().
  Eigen::VectorXd null_vector(int k) const;

 private:
  Matrix factor_;
  FactorCost cost_;
  int rows_ = 0;
  int local_rows_ = 0;  ///< rows of this rank
  int negative_ = 0;
  int null_ = 0;
  int failure_ = 0;  ///< MUMPS's INFOG(1), if negative
};

}  // namespace tisserand::reducer

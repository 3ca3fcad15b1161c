// SPDX-License-Identifier: GPL-3.0-or-later
// Factor L D Lᵀ of a sparse symmetric matrix by MUMPS through PETSc. It counts signs and finds null vectors, in one
// process or in all ranks together.
#pragma once

#include <Eigen/Core>

#include "reducer/algebra/cholesky.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// Factor L D Lᵀ of a sparse symmetric matrix A by MUMPS. If A is spread over several processes, all of them must call
/// every member together, and matrices hold the rows of the process.
class Mumps {
 public:
  /// Finds the elimination order of A. factor() will count pivots below `null_pivot` of the largest (after scaling) as
  /// null.
  Mumps(const Matrix& A, double null_pivot);
  /// Cost of the factorisation, as MUMPS estimates it.
  const FactorCost& cost() const { return cost_; }
  int rows() const { return rows_; }  ///< number of rows of the whole matrix

  /// Factors A. Requires the matrix of the constructor. A failure (such as short memory) occurs in all processes, and
  /// require_factored() reports it.
  void factor(const Matrix& A);
  /// Throws Error with reason and remedy if factor() failed.
  void require_factored() const;
  /// Number of negative eigenvalues of A, by Sylvester's law of inertia.
  int negative() const { return negative_; }
  int null() const { return null_; }

  /// Solution A⁻¹ B. Requires null() = 0.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// Vector `k` of a basis of the null space of A. Requires k < null().
  Eigen::VectorXd null_vector(int k) const;

 private:
  Matrix factor_;
  FactorCost cost_;
  int rows_ = 0;
  int local_rows_ = 0;  ///< number of rows in this process
  int negative_ = 0;
  int null_ = 0;
  int failure_ = 0;  ///< INFOG(1) of MUMPS after a failure, which is negative; else 0
};

}  // namespace tisserand::reducer

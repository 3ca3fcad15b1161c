// SPDX-License-Identifier: GPL-3.0-or-later
// Factorisation of a sparse symmetric matrix: L Lᵀ if it is clearly positive definite, otherwise L D Lᵀ, which counts
// signs and finds null vectors. If there are several ranks, all of them compute L D Lᵀ together.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include <Eigen/Core>

#include "reducer/algebra/cholesky.hpp"
#include "reducer/algebra/petsc.hpp"
#include "reducer/algebra/shared_factor.hpp"

namespace tisserand::reducer {

/// Owner of the factor. `negative` and `null` count eigenvalues of the matrix by sign (Sylvester's law of inertia).
class Factor {
 public:
  Factor() = default;  ///< factor of a matrix without rows
  /// Factors A, expected to be positive definite. If a pivot is below 1e-12 of its diagonal entry, MUMPS factors.
  /// Pivots below 1e-18 of the largest (after scaling) count as null and do not fail. null_space() finds motions
  /// without stiffness; pivots do not.
  explicit Factor(const Matrix& A) : Factor(A, nullptr) {}
  /// `accept` receives the cost before the factorisation and may throw.
  Factor(const Matrix& A, const std::function<void(const FactorCost&)>& accept);

  /// L D Lᵀ of any symmetric A. Pivots below `null_pivot` of the largest count as null.
  static Factor indefinite(const Matrix& A, double null_pivot);
  static Factor indefinite(const Matrix& A) { return indefinite(A, 1e-14); }

  int negative() const;
  int null() const;
  /// Least ratio of a pivot to its diagonal entry if all pivots are clearly positive; 0 if it is not known.
  double least_pivot() const { return definite_ == nullptr ? 0.0 : least_pivot_; }
  /// Entries and operations of L; an estimate if MUMPS factors.
  const FactorCost& cost() const { return cost_; }

  /// Sets a function that receives the number of columns when a solution begins, and 0 when it ends (for timing).
  void tell_solutions(std::function<void(int)> heard) { heard_ = std::move(heard); }
  /// Solution A⁻¹ B. Only if null() is 0.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// A basis of the null space (n x null()).
  Eigen::MatrixXd null_vectors() const;
  /// The factor spread over several ranks, or null.
  const SharedFactor* shared() const { return shared_.get(); }

 private:
  void factor_indefinite(const Matrix& A, double null_pivot, const std::function<void(const FactorCost&)>& accept);
  const Mumps* mumps() const;
  Eigen::MatrixXd solution(const Eigen::MatrixXd& B) const;

  std::unique_ptr<Cholesky> definite_;
  std::unique_ptr<Mumps> indefinite_;
  std::unique_ptr<SharedFactor> shared_;
  std::function<void(int)> heard_;
  FactorCost cost_;
  int size_ = 0;
  double least_pivot_ = 0.0;
};

}  // namespace tisserand::reducer

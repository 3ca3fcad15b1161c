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

/// Factor of a sparse symmetric matrix A with solutions A⁻¹ B. negative() and null() are the numbers of negative and
/// zero eigenvalues of A, by Sylvester's law of inertia.
class Factor {
 public:
  Factor() = default;  ///< makes the factor of a matrix without rows
  /// Factors A, which should be positive definite. If a pivot is below 1e-12 of its diagonal entry, MUMPS factors A
  /// instead of CHOLMOD. Pivots below 1e-18 of the largest (after scaling) then count as null and do not fail. They do
  /// not prove motions without stiffness, which null_space() finds.
  explicit Factor(const Matrix& A) : Factor(A, nullptr) {}
  /// Factors A. `accept` receives the cost before the factorisation, and may throw to prevent it.
  Factor(const Matrix& A, const std::function<void(const FactorCost&)>& accept);

  /// Factor L D Lᵀ of any symmetric A. Pivots below `null_pivot` of the largest count as null.
  static Factor indefinite(const Matrix& A, double null_pivot);
  static Factor indefinite(const Matrix& A) { return indefinite(A, 1e-14); }

  int negative() const;
  int null() const;
  /// Least ratio of a pivot to its diagonal entry, if CHOLMOD has factored A; 0 if it is not known.
  double least_pivot() const { return definite_ == nullptr ? 0.0 : least_pivot_; }
  /// Number of entries of L and operations; an estimate if MUMPS has factored A.
  const FactorCost& cost() const { return cost_; }

  /// Sets a function, for measurements of time. It receives the number of columns when a solution begins, and 0 when
  /// it ends.
  void report_solutions(std::function<void(int)> heard) { heard_ = std::move(heard); }
  /// Solution A⁻¹ B. Requires null() = 0.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// Basis of the null space of A (n x null()).
  Eigen::MatrixXd null_vectors() const;
  /// Factor that is spread over several processes; null if this process holds the whole factor.
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

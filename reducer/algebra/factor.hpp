// Factorisation of a sparse symmetric matrix: L Lᵀ where it is clearly positive definite, else L D Lᵀ, which counts
// signs and finds null vectors; L D Lᵀ by all ranks where there are several.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include <Eigen/Core>

#include "reducer/algebra/cholesky.hpp"
#include "reducer/algebra/petsc.hpp"
#include "reducer/algebra/shared_factor.hpp"

namespace tisserand::reducer {

/// Owns the factor; `negative` and `null` are counts of eigenvalues of the matrix by sign (Sylvester's law of inertia).
class Factor {
 public:
  Factor() = default;  ///< of a matrix without rows
  /// Factors A, expected to be positive definite. If a pivot is below 1e-12 of the diagonal entry that it comes from,
  /// MUMPS factors, and pivots below 1e-18 of the largest (after scaling) count as null and do not fail. What has no
  /// stiffness is found by null_space(), not by pivots.
  explicit Factor(const Matrix& A) : Factor(A, nullptr) {}
  /// `accept` hears what the factorisation will cost, and may throw.
  Factor(const Matrix& A, const std::function<void(const FactorCost&)>& accept);

  /// L D Lᵀ of any A; pivots below `null_pivot` of the largest count as null.
  static Factor indefinite(const Matrix& A, double null_pivot);
  static Factor indefinite(const Matrix& A) { return indefinite(A, 1e-14); }

  int negative() const;
  int null() const;
  /// The least pivot over the diagonal entry that it comes from, where all are clearly positive; else 0: not known.
  double least_pivot() const { return definite_ == nullptr ? 0.0 : least_pivot_; }
  /// Entries and operations of L; of MUMPS by its own estimate.
  const FactorCost& cost() const { return cost_; }

  /// `heard` hears the number of columns when a solution begins, and 0 when it ends: for whoever has a clock.
  void tell_solutions(std::function<void(int)> heard) { heard_ = std::move(heard); }
  /// A⁻¹ B. Only if null() is 0.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// A basis of the null space (n x null()).
  Eigen::MatrixXd null_vectors() const;
  /// Null unless it lies on several ranks.
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

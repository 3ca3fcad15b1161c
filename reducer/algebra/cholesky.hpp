// SPDX-License-Identifier: GPL-3.0-or-later
// Factor L Lᵀ of a large sparse symmetric positive definite matrix (CHOLMOD, supernodal), with solutions for blocks of
// right-hand sides.
#pragma once

#include <memory>

#include <Eigen/Core>

#include "reducer/algebra/symmetric_rows.hpp"

namespace tisserand::reducer {

/// Cost of a factorisation, which is known before the factorisation.
struct FactorCost {
  double entries = 0.0;     ///< number of stored entries of L
  double operations = 0.0;  ///< floating-point operations
  double bytes() const { return 8.0 * entries; }
};

/// Factorisation P A Pᵀ = L Lᵀ of a sparse symmetric matrix A, with the permutation P by nested dissection (METIS).
/// The rows of A must live until factor() has returned.
class Cholesky {
 public:
  /// Finds the permutation P and the pattern of L. Throws Error if the pattern exceeds the indices of CHOLMOD.
  explicit Cholesky(const SymmetricRows& A);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  const FactorCost& cost() const { return cost_; }

  /// Computes L. Returns the least l_jj²/a_jj, which is the share of a diagonal entry that remains after elimination.
  /// The result is 0 if A is not positive definite, and there is no L then. It is negative if the memory does not
  /// suffice.
  double factor();

  /// Solution A⁻¹ B. Each column of the result is independent of the other columns, to the last bit. Requires a
  /// successful factor().
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  FactorCost cost_;
};

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Factor L Lᵀ of a large sparse symmetric positive definite matrix (CHOLMOD, supernodal), with solutions for blocks of
// right-hand sides.
#pragma once

#include <memory>

#include <Eigen/Core>

#include "reducer/algebra/symmetric_rows.hpp"

namespace tisserand::reducer {

/// Cost of a factorisation, known before it is done.
struct FactorCost {
  double entries = 0.0;     ///< stored entries of L
  double operations = 0.0;  ///< floating-point operations
  double bytes() const { return 8.0 * entries; }
};

/// Factorisation P A Pᵀ = L Lᵀ, P by nested dissection (METIS). The rows of A must live until factor() has returned.
class Cholesky {
 public:
  /// Finds the elimination order and the pattern of L. Throws Error if the pattern exceeds CHOLMOD's indices.
  explicit Cholesky(const SymmetricRows& A);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  const FactorCost& cost() const { return cost_; }

  /// Least l_jj²/a_jj, the share of a diagonal entry that remains after elimination. The result is 0 if A is not
  /// positive definite (no factor exists then) and negative if the memory does not suffice.
  double factor();

  /// Solution A⁻¹ B. Each column of the result is independent of the other columns, to the last bit.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  FactorCost cost_;
};

}  // namespace tisserand::reducer

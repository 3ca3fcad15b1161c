// L Lᵀ of a large sparse symmetric positive definite matrix (CHOLMOD, supernodal) and its solution for blocks of
// right-hand sides.
#pragma once

#include <memory>

#include <Eigen/Core>

#include "reducer/algebra/symmetric_rows.hpp"

namespace tisserand::reducer {

/// What a factorisation costs, known before it is done.
struct FactorCost {
  double entries = 0.0;     ///< of L
  double operations = 0.0;  ///< floating-point ones
  double bytes() const { return 8.0 * entries; }
};

/// P A Pᵀ = L Lᵀ, P by nested dissection (METIS). The rows of A are looked at until the factor is made.
class Cholesky {
 public:
  /// The order of elimination and the pattern of L. Throws Error if the pattern exceeds CHOLMOD's indices.
  explicit Cholesky(const SymmetricRows& A);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  const FactorCost& cost() const { return cost_; }

  /// The least l_jj²/a_jj, the share of a diagonal entry that elimination leaves; 0 if A is not positive definite (then
  /// there is no factor), and negative if the memory does not suffice.
  double factor();

  /// A⁻¹ B. A column of the result does not depend on the others, to the last bit.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  FactorCost cost_;
};

}  // namespace tisserand::reducer

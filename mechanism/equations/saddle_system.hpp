// The one linear system of this stage: [A Bᵀ; C 0][d; μ] = [f; g], scaled so that pivots do not depend on units.
#pragma once

#include <Eigen/Core>

#include "mechanism/equations/tangent.hpp"
#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

/// Values, factors and the vector of unknowns of one such matrix; A is stored as A/s. The matrix of Newton's iteration
/// and that of the position projection are two of them.
class SaddleSystem {
 public:
  explicit SaddleSystem(const Model& model);  ///< symbolic factorisation

  /// Factors the values. Fill `matrix` with evaluate_tangent() or evaluate_weight() before: factoring scales it in
  /// place, and it must then stay as it is.
  [[nodiscard]] FactorReport factor(const Model& model);
  /// unknowns <- solution for the right-hand side in `unknowns`. The upper part of the right-hand side belongs to A/s,
  /// and so do the multipliers that come back.
  void solve(const Model& model);
  /// Forgets pivots and factors, so that the next factor() does what the first did.
  void forget() { solver_.forget(); }
  const SolverHealth& health() const { return solver_.health(); }

  MatrixValues matrix;
  Eigen::VectorXd unknowns;  ///< boundary coordinates, then multipliers

 private:
  LinearSolver solver_;
};

}  // namespace tisserand::mechanism

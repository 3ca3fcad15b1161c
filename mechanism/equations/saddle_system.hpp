// SPDX-License-Identifier: GPL-3.0-or-later
// The linear system [A Bᵀ; C 0][d; μ] = [f; g], scaled so that pivots do not depend on units.
#pragma once

#include <Eigen/Core>

#include "mechanism/equations/tangent.hpp"
#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

/// Linear system [A Bᵀ; C 0][d; μ] = [f; g]: values of the matrix, factors and vector of unknowns. A is stored as A/s,
/// s = MatrixValues::scale. Newton's iteration has one such system, the position projection another.
class SaddleSystem {
 public:
  explicit SaddleSystem(const Model& model);  ///< performs the symbolic factorisation

  /// Factors the values in `matrix`. Requires evaluate_tangent() or evaluate_weight() before. The factorisation scales
  /// `matrix` in place, so the caller must not change it afterwards.
  [[nodiscard]] FactorReport factor(const Model& model);
  /// Replaces the right-hand side [f/s; g] in `unknowns` by the solution [d; μ/s]. The caller must divide f by s, and
  /// multiply the multipliers by s.
  void solve(const Model& model);
  /// Discards pivots and factors, so that the next factor() repeats the first one.
  void forget() { solver_.forget(); }
  const SolverHealth& health() const { return solver_.health(); }

  MatrixValues matrix;
  Eigen::VectorXd unknowns;  ///< boundary coordinates, then multipliers

 private:
  LinearSolver solver_;
};

}  // namespace tisserand::mechanism

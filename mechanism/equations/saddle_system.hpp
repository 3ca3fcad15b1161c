// SPDX-License-Identifier: GPL-3.0-or-later
// The linear system [A Bᵀ; C 0][d; μ] = [f; g], scaled so that pivots do not depend on units.
#pragma once

#include <Eigen/Core>

#include "mechanism/equations/tangent.hpp"
#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

/// Values, factors and the vector of unknowns of one such matrix; A is stored as A/s. The matrices of Newton's
/// iteration and of the position projection are two of them.
class SaddleSystem {
 public:
  explicit SaddleSystem(const Model& model);  ///< performs the symbolic factorisation

  /// Factors the values. Before, evaluate_tangent() or evaluate_weight() must fill `matrix`. The factorisation scales
  /// it in place, so it must not change afterwards.
  [[nodiscard]] FactorReport factor(const Model& model);
  /// Replaces the right-hand side in `unknowns` by the solution. The upper part of the right-hand side belongs to A/s,
  /// and so do the resulting multipliers.
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

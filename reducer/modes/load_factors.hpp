// SPDX-License-Identifier: GPL-3.0-or-later
// Buckling: multiples of a stress at which a part loses its stability, (S + λ K_g) φ = 0.
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "reducer/algebra/factor.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// Input: S positive definite, K_g symmetric of any sign with the same pattern, and the factor of S.
struct StressPencil {
  const Matrix& S;
  const Matrix& K_g;
  const Factor& factor;
  std::function<void(double)> share = [](double /*done*/) {};  ///< receives the approximate share that is done
};

/// Buckling loads as multiples of a load, lowest first, with the results of their checks.
struct LoadFactors {
  Eigen::VectorXd factor;  ///< λ > 0, ascending
  Eigen::MatrixXd shape;   ///< φ in columns, φᵀ S φ = 1
  /// Lowest factor of the reversed load as a positive number, if one is below `limit`.
  std::optional<double> reversed;
  double limit = 0.0;     ///< larger factors are ignored: 1e3 times the lowest of either sign; 0: K_g vanishes
  int more_equal = 0;     ///< further factors that equal the last one, if there are many
  double residual = 0.0;  ///< largest ‖φ + λ S⁻¹ K_g φ‖_S / ‖φ‖_S
};

/// The `count` lowest factors, or all if fewer exist; a small group of equal ones is completed. They come from
/// Krylov-Schur iteration on K_g φ = μ S φ, μ = −1/λ, in the inner product of S. It uses shift and inversion from just
/// below the lowest factor, where S + λ K_g is still positive definite. Counts of the negative eigenvalues of S + λ K_g
/// at a few λ, one factorisation each, give this point. They also show that no factor is missing (Sylvester's law of
/// inertia). Throws Error if factors are still missing after repeated searches, or if the residual is above 1e-6.
LoadFactors load_factors(const StressPencil& pencil, int count);

}  // namespace tisserand::reducer

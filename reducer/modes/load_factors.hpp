// SPDX-License-Identifier: GPL-3.0-or-later
// Buckling: multiples of a stress at which a part loses its stability, (S + λ K_g) φ = 0.
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "reducer/algebra/factor.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// Input of load_factors(): stiffness S (positive definite), geometric stiffness K_g of a load (symmetric, of any
/// sign, with the pattern of S), and the factor of S.
struct StressPencil {
  const Matrix& S;
  const Matrix& K_g;
  const Factor& factor;
  std::function<void(double)> share = [](double /*done*/) {};  ///< receives the approximate completed share, 0 to 1
};

/// Buckling loads (S + λ K_g) φ = 0 as factors λ of a load, lowest first, with the results of their checks.
struct LoadFactors {
  Eigen::VectorXd factor;  ///< buckling factors λ > 0, ascending
  Eigen::MatrixXd shape;   ///< buckling shapes φ in columns, φᵀ S φ = 1
  /// Lowest buckling factor of the reversed load, as a positive number. Absent if none is below `limit`.
  std::optional<double> reversed;
  /// Limit above which factors are ignored, 1e3 times the lowest of either sign; 0: K_g vanishes.
  double limit = 0.0;
  int more_equal = 0;     ///< number of further factors, equal to the last one, that were not computed
  double residual = 0.0;  ///< largest residual ‖φ + λ S⁻¹ K_g φ‖_S / ‖φ‖_S
};

/// Computes the `count` lowest positive buckling factors, or all if fewer exist. A small group of equal factors at the
/// end is completed. Krylov-Schur iteration solves K_g φ = μ S φ, μ = −1/λ, in the inner product of S. It inverts at a
/// shift just below the lowest factor, where S + λ K_g is still positive definite. Counts of the negative eigenvalues
/// of S + λ K_g at a few λ give this shift; each costs one factorisation. By Sylvester's law of inertia the counts
/// also show that no factor is missing. Throws Error if factors are still missing after repeated searches, or if the
/// residual is above 1e-6.
LoadFactors load_factors(const StressPencil& pencil, int count);

}  // namespace tisserand::reducer

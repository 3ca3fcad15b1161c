// Multiples of a stress at which a part loses its stability: (S + λ K_g) φ = 0.
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "reducer/algebra/factor.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// S positive definite, K_g symmetric of any sign, on one pattern; the factor of S.
struct StressPencil {
  const Matrix& S;
  const Matrix& K_g;
  const Factor& factor;
  std::function<void(double)> share = [](double /*done*/) {};  ///< hears how much of the search is done, about
};

/// Buckling loads as multiples of a load, lowest first, with the results of their checks.
struct LoadFactors {
  Eigen::VectorXd factor;  ///< λ > 0, ascending
  Eigen::MatrixXd shape;   ///< φ in columns, φᵀ S φ = 1
  /// The lowest factor of the reversed load, as a positive number; none below `limit`.
  std::optional<double> reversed;
  double limit = 0.0;     ///< factors above it count as none: 1e3 times the lowest of either sign; 0: K_g vanishes
  int more_equal = 0;     ///< factors behind the last one that equal it, where these are many
  double residual = 0.0;  ///< largest ‖φ + λ S⁻¹ K_g φ‖_S / ‖φ‖_S
};

/// The `count` lowest factors, or all if fewer exist; a group of few equal ones is completed. Krylov-Schur iteration on
/// K_g φ = μ S φ, μ = −1/λ, in the inner product of S, by shift and inversion from just below the lowest factor, where
/// S + λ K_g is still positive definite. That place, and that no factor is missing, come from counting the negative
/// eigenvalues of S + λ K_g at a few λ (Sylvester's law of inertia), each by a factorisation. Throws Error if factors
/// are still missing after repeated searches, or if the residual is above 1e-6. Without the shift the iteration stalls
/// at the end of the spectrum with the smaller |μ|: 500 restarts did not find the reversed load of a cruciform.
LoadFactors load_factors(const StressPencil& pencil, int count);

}  // namespace tisserand::reducer

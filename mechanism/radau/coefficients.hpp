// SPDX-License-Identifier: GPL-3.0-or-later
// Radau IIA of three stages: coefficients, and the transformation that decouples its Newton iteration.
#pragma once

#include <complex>

#include <Eigen/Core>

namespace tisserand::mechanism::radau {

/// Coefficients of Radau IIA of three stages, [HW96] IV.5 table 5.6 and IV.8. T diagonalises the inverse of A: A⁻¹ = T
/// Λ T⁻¹ with Λ = [γ 0 0; 0 α −β; 0 β α].
struct Coefficients {
  Eigen::Vector3d c;        ///< instants of the stages as shares of the step; the last is 1
  Eigen::Matrix3d A;        ///< increment of stage i = h Σ a_ij rate j; last row: the step
  Eigen::Matrix3d inverse;  ///< inverse A⁻¹ of the matrix of the method
  Eigen::Matrix3d T, T_inverse;
  double gamma = 0.0;  ///< γ: real eigenvalue of A⁻¹
  /// Eigenvalue α + iβ of A⁻¹, for column 2 + i column 3 of the transformed unknowns.
  std::complex<double> pair;
  /// Coefficients e_i of the error estimate (1/γ) h f₀ + Σ e_i z_i with the rates f₀ at the start and the increments
  /// z_i of the stages, [HW96] IV (8.17).
  Eigen::Vector3d e;
};

const Coefficients& coefficients();

}  // namespace tisserand::mechanism::radau

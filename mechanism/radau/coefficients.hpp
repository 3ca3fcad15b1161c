// SPDX-License-Identifier: GPL-3.0-or-later
// Radau IIA of three stages: coefficients, and the transformation that decouples its Newton iteration.
#pragma once

#include <complex>

#include <Eigen/Core>

namespace tisserand::mechanism::radau {

/// Coefficients of the method, [HW96] IV.5 table 5.6 and IV.8: A⁻¹ = T Λ T⁻¹ with Λ = [γ 0 0; 0 α −β; 0 β α].
struct Coefficients {
  Eigen::Vector3d c;        ///< positions of the stages in the step, the last one 1
  Eigen::Matrix3d A;        ///< stage i = Σ a_ij rate j; the last row gives the end of the step
  Eigen::Matrix3d inverse;  ///< A⁻¹
  Eigen::Matrix3d T, T_inverse;
  double gamma = 0.0;         ///< the real eigenvalue of A⁻¹
  std::complex<double> pair;  ///< eigenvalue α + iβ, for column 2 + i column 3 of the transformed unknowns
  Eigen::Vector3d e;          ///< coefficients of the error: (1/γ) h f₀ + Σ e_i z_i, IV (8.17)
};

const Coefficients& coefficients();

}  // namespace tisserand::mechanism::radau

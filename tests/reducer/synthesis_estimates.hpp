// SPDX-License-Identifier: GPL-3.0-or-later
// How good reduced modes are: an a-posteriori estimate of their error, and their likeness to those of the full model;
// for the tests and the table of verification.
#pragma once

#include <Eigen/Core>

#include "formats/part/part.hpp"

namespace tisserand::testing {

/// Elastic modes, ascending, of a floating part; eigenvalues λ = ω². One row per reduced mode, rigid ones left out.
struct ModeQuality {
  Eigen::VectorXd frequency;  ///< of the full model [1/time]
  Eigen::VectorXd error;      ///< λ_reduced/λ_full - 1
  Eigen::VectorXd estimate;   ///< of `error`, without the full model's modes (below)
  Eigen::VectorXd bound;  ///< of `error`: λ/(λ_c - λ), λ_c the first dropped fixed-interface one (Elssel and Voss
                          ///< 2006); infinite from λ_c on
  Eigen::VectorXd mac;    ///< (xᵀy)²/(xᵀx yᵀy), no weights: translations and rotations as numbers, in part units
  Eigen::VectorXd cross_orthogonality;  ///< |xᵀ M y|, both of unit modal mass
  double solver_difference = 0.0;       ///< largest difference of λ from the reducer's S̄, M̄, relative
};

/// Dense Craig-Bampton of the part with its number of modes m, x = T φ for the reduced mode φ = [φ_I; φ_B].
///
/// The estimate, after Kim and Lee (International Journal for Numerical Methods in Engineering 103 (2015) 79-93),
/// derived here: the inside of an exact mode obeys (S_II - λ M_II) w = λ A φ_B, A = M_IB + M_II Ψ, w = x_I - Ψ φ_B; the
/// dropped modes answer with x_a = λ F A φ_B to the first order in λ/λ_dropped, F = S_II⁻¹ - Φ Λ⁻¹ Φᵀ. If x + x_a were
/// exact, (S/λ - M)(x + x_a) = 0 and so λ_reduced/λ - 1 = xᵀ D x = -2 xᵀ D x_a - x_aᵀ D x_a with D = S/λ - M, xᵀ M x =
/// 1; λ_reduced serves as λ in D and x_a.
ModeQuality mode_quality(const formats::Part& part, double shift);

}  // namespace tisserand::testing

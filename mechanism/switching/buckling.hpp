// SPDX-License-Identifier: GPL-3.0-or-later
// Nearness to buckling of a body under the loads that deform it.
#pragma once

#include <Eigen/Core>

#include "mechanism/switching/compliance.hpp"

namespace tisserand::mechanism {

/// Nearness to buckling of a body with stiffening under the stress that deforms it. It holds constants that are made
/// once: the geometric stiffness in elastic coordinates z. They describe deformations y = W z with the columns W of
/// SuperelementCompliance::elastic_shapes().
class Buckling {
 public:
  /// Makes the constants of a body with stiffening. `compliance`: compliance of the same body. Requires that `body`
  /// outlives this object.
  Buckling(const SuperelementBody& body, const SuperelementCompliance& compliance);

  /// Fraction p of the buckling load that the stress of the deformation y is (p = 1: buckling). The ends are free and
  /// do not turn with the chord, so the load is π² EI/l² for a straight beam. p = −λ for the lowest eigenvalue λ of Wᵀ
  /// K_σ W, where K_σ = Σ (l_a·y) Γ_a has the arrays of THEORY (43). p = 0 if all eigenvalues are positive.
  double load_share(const Eigen::VectorXd& y) const;
  /// Upper bound of load_share() in a few operations: Σ |l_a·y| ‖Wᵀ Γ_a W‖, arrays as in THEORY (43).
  double bound(const Eigen::VectorXd& y) const { return (stiffening_->L * y).cwiseAbs().dot(norms_); }

 private:
  const Stiffening* stiffening_;
  Eigen::MatrixXd W_;      ///< elastic shapes W (N x elastic coordinates)
  Eigen::VectorXd norms_;  ///< norm ‖Wᵀ Γ_a W‖ for each row l_a of L, THEORY (43)
};

}  // namespace tisserand::mechanism

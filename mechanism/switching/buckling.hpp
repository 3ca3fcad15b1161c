// SPDX-License-Identifier: GPL-3.0-or-later
// Nearness to buckling of a body under the loads that deform it.
#pragma once

#include <Eigen/Core>

#include "mechanism/switching/compliance.hpp"

namespace tisserand::mechanism {

/// Constants of a body with stiffening, made once: its stiffness under initial stress in elastic coordinates z, y = W
/// z, WᵀS̄W = 1, without rigid motion.
class Buckling {
 public:
  Buckling(const SuperelementBody& body, const SuperelementCompliance& compliance);

  /// Fraction p of the buckling load that the stress of y is, with free ends that do not turn with the chord (π² EI/l²
  /// for a straight beam). p = −λ for the lowest eigenvalue λ of Wᵀ K_σ W, K_σ = Σ (l_a·y) Γ_a ([SO] 3). p = 0 if all
  /// eigenvalues are positive.
  double load_share(const Eigen::VectorXd& y) const;
  /// Upper bound of load_share() in a few operations: Σ |l_a·y| ‖Wᵀ Γ_a W‖.
  double bound(const Eigen::VectorXd& y) const { return (stiffening_->L * y).cwiseAbs().dot(norms_); }

 private:
  const Stiffening* stiffening_;
  Eigen::MatrixXd W_;      ///< N x elastic coordinates
  Eigen::VectorXd norms_;  ///< ‖Wᵀ Γ_a W‖ for each row of L
};

}  // namespace tisserand::mechanism

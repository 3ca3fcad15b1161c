// How near the loads that deform a body bring it to buckling.
#pragma once

#include <Eigen/Core>

#include "mechanism/switching/compliance.hpp"

namespace tisserand::mechanism {

/// Constants of a body with stiffening, made once: the forms of its stiffness under initial stress in elastic
/// coordinates z, y = W z, WᵀS̄W = 1, without rigid motion.
class Buckling {
 public:
  Buckling(const SuperelementBody& body, const SuperelementCompliance& compliance);

  /// p, the part of the load of buckling that the stress of y is, with free ends that do not turn with the chord
  /// (π² EI/l² of a straight beam): −λ for the lowest eigenvalue λ of Wᵀ K_σ W, K_σ = Σ (l_a·y) Γ_a, THEORY (43); 0
  /// where all of them are positive.
  double load_share(const Eigen::VectorXd& y) const;
  /// Not below load_share(), in a few operations: Σ |l_a·y| ‖Wᵀ Γ_a W‖.
  double bound(const Eigen::VectorXd& y) const { return (stiffening_->L * y).cwiseAbs().dot(norms_); }

 private:
  const Stiffening* stiffening_;
  Eigen::MatrixXd W_;      ///< N x elastic coordinates
  Eigen::VectorXd norms_;  ///< of each row of L
};

}  // namespace tisserand::mechanism

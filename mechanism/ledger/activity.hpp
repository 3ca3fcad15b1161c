// SPDX-License-Identifier: GPL-3.0-or-later
// Activity of an effect: the absolute power that flows through it, integrated over the windows of a ledger.
#pragma once

#include <string>
#include <vector>

#include "mechanism/ledger/replay.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Powers at the rows of the windows of a ledger, from which the activity of each effect follows. Activity is A = ∫ |P|
/// dt by the trapezoidal rule, by which [LSH10] ranks elements of nonlinear models. The power of an effect is P = v·(r'
/// − r) with the velocities v. Here r' and r are the residuals, THEORY (58), of the models with and without the effect.
/// Both are taken at equal positions, velocities, accelerations and multipliers. Internal coordinates are included.
class SampledPowers {
 public:
  /// Computes the residuals of the model at all rows of the windows. Requires that the model and the windows outlive
  /// this object.
  SampledPowers(const Model& model, const std::vector<WindowHistory>& windows);

  /// Activity [energy] of the effect by which the model `other` differs from the model of this object. Requires that
  /// share_states() holds for both.
  double of_difference(const Model& other) const;
  /// Activity of the strain energy W of a superelement or modal body: Σ |ΔW| over the rows.
  double of_strain(const std::string& body) const;

 private:
  const Model& model_;
  const std::vector<WindowHistory>& windows_;
  std::vector<std::vector<Eigen::VectorXd>> residuals_;  ///< residuals of the model, indexed by window and row
};

}  // namespace tisserand::mechanism

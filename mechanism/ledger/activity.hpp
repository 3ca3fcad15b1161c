// SPDX-License-Identifier: GPL-3.0-or-later
// Activity of an effect: the absolute power that flows through it, integrated over the windows of a ledger.
#pragma once

#include <string>
#include <vector>

#include "mechanism/ledger/replay.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Activity A = ∫ |P| dt by the trapezoidal rule over the rows of the windows. [LSH10] ranks elements of nonlinear
/// models by it. The force of an effect is r' − r: residuals of the models with and without it at equal positions,
/// velocities, accelerations and multipliers. Its power is P = v·(r' − r). Internal coordinates are included.
class SampledPowers {
 public:
  /// The model and the windows must outlive this object.
  SampledPowers(const Model& model, const std::vector<WindowHistory>& windows);

  /// Activity of the effect in which `other` differs from the model. Both share states (switching/transfer.hpp).
  double of_difference(const Model& other) const;
  /// Activity of the strain energy W of a superelement or modal body: Σ |ΔW| between rows.
  double of_strain(const std::string& body) const;

 private:
  const Model& model_;
  const std::vector<WindowHistory>& windows_;
  std::vector<std::vector<Eigen::VectorXd>> residuals_;  ///< residuals of the model, per window and row
};

}  // namespace tisserand::mechanism

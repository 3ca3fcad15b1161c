// Activity of an effect: the power that flows through it, whatever its direction, over the windows of a ledger.
#pragma once

#include <string>
#include <vector>

#include "mechanism/ledger/replay.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// A = ∫ |P| dt over the rows of the windows by the trapezoidal rule: the activity of an element in [LSH10], by which
/// it ranks elements of nonlinear models.
/// P = v·(r' − r): the force of an effect is what the residuals of the models with and without it differ by at the same
/// positions, velocities, accelerations and multipliers; one formula for all of them, internal coordinates included.
class SampledPowers {
 public:
  /// Model and states live as long as this.
  SampledPowers(const Model& model, const std::vector<WindowHistory>& windows);

  /// Of what `other` has more or less than the model; they share states (switching/transfer.hpp).
  double of_difference(const Model& other) const;
  /// Of the strain of a superelement or modal body: Σ |ΔW| between rows.
  double of_strain(const std::string& body) const;

 private:
  const Model& model_;
  const std::vector<WindowHistory>& windows_;
  std::vector<std::vector<Eigen::VectorXd>> residuals_;  ///< per window and row
};

}  // namespace tisserand::mechanism

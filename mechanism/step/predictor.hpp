// SPDX-License-Identifier: GPL-3.0-or-later
// Prediction of the next acceleration in smooth motion, better than the last acceleration.
#pragma once

#include <Eigen/Core>

#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/generalised_alpha.hpp"

namespace tisserand::mechanism {

/// Change of algorithmic acceleration and multipliers over the last step. It predicts the next step if, one step
/// earlier, such a prediction would have been better than none.
struct Predictor {
  explicit Predictor(const Sizes& sizes)
      : acceleration(Eigen::VectorXd::Zero(sizes.velocities())),
        multipliers(Eigen::VectorXd::Zero(sizes.constraints)) {}
  void forget() { known = smooth = false; }
  /// Updates the prediction from the step just solved, from `last` to `state`. smooth_rate: StepTuning.
  void learn(const Model& model, double step, double smooth_rate, const State& last, const State& state);

  Eigen::VectorXd acceleration, multipliers;
  bool known = false;   ///< the last step had the size of this one
  bool smooth = false;  ///< the prediction would have improved the last step
};

/// Adds the predicted change to acceleration and multipliers after predict(). `last`: state at the start of the step.
void foresee(const Predictor& predictor, const StepScheme& scheme, const State& last, State& state,
             Evaluation& evaluation);

}  // namespace tisserand::mechanism

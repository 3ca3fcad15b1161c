// SPDX-License-Identifier: GPL-3.0-or-later
// Prediction of the next acceleration in smooth motion, better than the last acceleration.
#pragma once

#include <Eigen/Core>

#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/generalised_alpha.hpp"

namespace tisserand::mechanism {

/// Prediction of the change of algorithmic acceleration and multipliers in the next step: their change over the last
/// step. It is used if, one step earlier, such a prediction would have been better than none.
struct Predictor {
  explicit Predictor(const Sizes& sizes)
      : acceleration(Eigen::VectorXd::Zero(sizes.velocities())),
        multipliers(Eigen::VectorXd::Zero(sizes.constraints)) {}
  void forget() { known = smooth = false; }
  /// Updates the prediction from the step just solved, from `last` to `state`. `smooth_rate`: StepTuning::smooth_rate.
  void learn(const Model& model, double step, double smooth_rate, const State& last, const State& state);

  Eigen::VectorXd acceleration, multipliers;
  bool known = false;   ///< the last step had the size of this one
  bool smooth = false;  ///< the prediction would have improved the last step
};

/// Adds the predicted change to acceleration and multipliers, if the motion is smooth. Requires predict() of
/// generalised_alpha.hpp. `last`: state at the start of the step.
void foresee(const Predictor& predictor, const StepScheme& scheme, const State& last, State& state,
             Evaluation& evaluation);

}  // namespace tisserand::mechanism

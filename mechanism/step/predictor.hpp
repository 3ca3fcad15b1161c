// A better guess of the next acceleration than the last one, where the motion is smooth.
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
  /// Learns from the step just solved, from `last` to `state`. smooth_rate: StepTuning.
  void learn(const Model& model, double step, double smooth_rate, const State& last, const State& state);

  Eigen::VectorXd acceleration, multipliers;
  bool known = false;   ///< the last step had the size of this one
  bool smooth = false;  ///< it would have been predicted better
};

/// Adds the change to acceleration and multipliers of a step that is `predict`ed; `last`: the state where it begins.
void foresee(const Predictor& predictor, const StepScheme& scheme, const State& last, State& state,
             Evaluation& evaluation);

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Prediction of the next change from the last two.
#include "mechanism/step/predictor.hpp"

#include <algorithm>
#include <cmath>

namespace tisserand::mechanism {

void foresee(const Predictor& predictor, const StepScheme& scheme, const State& last, State& state,
             Evaluation& evaluation) {
  if (!predictor.smooth || last.step() != scheme.step) return;
  state.lambda() += predictor.multipliers;
  add_acceleration(scheme, predictor.acceleration, state, evaluation);
}

void Predictor::learn(const Model& model, double step, double smooth_rate, const State& last, const State& state) {
  if (last.step() != step) {
    forget();
    return;
  }
  // The largest change of an acceleration, rotations times the length, and its difference from the previous change.
  double change = 0.0, rest = 0.0;
  for (int i = 0; i < model.sizes.boundary; ++i) {
    const double one = state.algorithmic()[i] - last.algorithmic()[i];
    change = std::max(change, std::abs(one) / model.equation_scale[i]);
    rest = std::max(rest, std::abs(one - acceleration[i]) / model.equation_scale[i]);
  }
  smooth = known && rest < smooth_rate * change;
  known = true;
  acceleration = state.algorithmic() - last.algorithmic();
  multipliers = state.lambda() - last.lambda();
}

}  // namespace tisserand::mechanism

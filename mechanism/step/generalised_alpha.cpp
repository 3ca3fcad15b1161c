// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters and updates of the scheme.
#include "mechanism/step/generalised_alpha.hpp"

#include <cmath>

#include "mechanism/step/tuning.hpp"

namespace tisserand::mechanism {

AlphaParameters alpha_parameters(const formats::IntegratorSpec& spec) {
  AlphaParameters p;
  switch (spec.method) {
    case formats::Method::bdf:  // these methods start like generalised alpha
    case formats::Method::radau:
    case formats::Method::automatic:
    case formats::Method::generalised_alpha:
      p.alpha_m = (2.0 * spec.rho - 1.0) / (spec.rho + 1.0);
      p.alpha_f = spec.rho / (spec.rho + 1.0);
      break;
    case formats::Method::hht:
      p.alpha_m = 0.0;
      p.alpha_f = spec.alpha;
      break;
  }
  p.gamma = 0.5 + p.alpha_f - p.alpha_m;
  p.beta = 0.25 * (p.gamma + 0.5) * (p.gamma + 0.5);
  return p;
}

TangentCoefficients step_coefficients(const AlphaParameters& p, double step) {
  return {(1.0 - p.alpha_m) / ((1.0 - p.alpha_f) * p.beta * step * step), p.gamma / (p.beta * step), 1.0};
}

void rebuild_algorithmic_acceleration(double step, State& state) {
  if (state.step() > 0.0)
    state.algorithmic() = state.vdot() + (step / state.step()) * (state.algorithmic() - state.vdot());
  state.step() = step;
}

StepScheme step_scheme(const Model& model, const formats::IntegratorSpec& options, const State& state, double end) {
  StepScheme scheme;
  scheme.alpha = alpha_parameters(options);
  const double difference = end - state.time();
  scheme.step = std::abs(difference - state.step()) <= same_step * difference ? state.step() : difference;
  scheme.request.coefficients = step_coefficients(scheme.alpha, scheme.step);
  const bool index3 = options.formulation == formats::Formulation::index3;
  scheme.request.rows =
      index3 ? ConstraintRows{ConstraintRows::Kind::position, 0.0}
             : ConstraintRows{ConstraintRows::Kind::velocity, scheme.alpha.beta * scheme.step / scheme.alpha.gamma};
  scheme.projects = !index3 && model.sizes.constraints > 0;
  return scheme;
}

void predict(const StepScheme& scheme, State& state, Evaluation& evaluation) {
  const double step = scheme.step;
  evaluation.displacement = step * state.v() + (0.5 * step * step) * state.algorithmic();
  state.v() += step * state.algorithmic();
  state.vdot() = (state.algorithmic() - scheme.alpha.alpha_f * state.vdot()) / (1.0 - scheme.alpha.alpha_f);
}

void add_acceleration(const StepScheme& scheme, const Eigen::VectorXd& change, State& state, Evaluation& evaluation) {
  const AlphaParameters& alpha = scheme.alpha;
  state.algorithmic() += change;
  state.v() += (alpha.gamma * scheme.step) * change;
  state.vdot() += ((1.0 - alpha.alpha_m) / (1.0 - alpha.alpha_f)) * change;
  evaluation.displacement += (alpha.beta * scheme.step * scheme.step) * change;
}

void correct(const StepScheme& scheme, const IterationMatrix& matrix, State& state, Evaluation& evaluation) {
  const TangentCoefficients& c = scheme.request.coefficients;
  state.algorithmic() += matrix.increment / (scheme.alpha.beta * scheme.step * scheme.step);
  state.v() += c.damping * matrix.increment;
  state.vdot() += c.mass * matrix.increment;
  evaluation.displacement += matrix.increment + matrix.correction;
  state.lambda() += matrix.multipliers;
}

}  // namespace tisserand::mechanism

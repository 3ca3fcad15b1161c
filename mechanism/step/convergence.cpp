// SPDX-License-Identifier: GPL-3.0-or-later
// Residuals and violations of one Newton iteration relative to their limits.
#include "mechanism/step/convergence.hpp"

#include <algorithm>
#include <limits>

#include "mechanism/equations/round_off.hpp"

namespace tisserand::mechanism {
namespace {

using formats::Formulation;
using formats::IntegratorSpec;

/// Largest error of an iterated floating frame [rad]. Its iteration ends at 1e-14 if it converges (frame.hpp). A larger
/// error shows that it does not.
constexpr double frame_tolerance = 1e-10;
/// Allowed violations of constraints relative to the motion of a step, in units of Newton's tolerance. A violation Φ
/// corresponds to an acceleration of 4 Φ/h² (β about 1/4), so with 5 its error may be about that of the forces.
constexpr double share_of_motion = 5.0;

/// Keeps the larger value and its index. The first NaN stays.
void raise(double& value, int& at, double candidate, int index) {
  if (candidate <= value || std::isnan(value)) return;
  value = candidate;
  at = index;
}

/// Finds the maximum first, then its index: a combined search cannot be vectorised. A NaN is the largest.
template <class Array>
double largest(const Array& values, int& at) {
  const double size = values.template maxCoeff<Eigen::PropagateNaN>();
  const auto is_it = [size](double value) { return std::isnan(size) ? std::isnan(value) : value >= size; };
  for (at = 0; at < values.size() - 1 && !is_it(values.coeff(at));) ++at;
  return size;
}

/// Violations up to which a constraint counts as closed, relative to the characteristic length.
struct Closed {
  double position = 0.0;
  double rate = 0.0;  ///< [1/time]
};

/// Limits of closed constraints. A violation Φ corresponds to an acceleration of about 4 Φ/h², a violation B v to B
/// v/h. It is small against the accelerations of the motion only if Φ is small against their displacement in a step.
/// The limit is not below the round-off; for Φ this is the round-off of the positions.
Closed closed_constraints(const Model& model, const IntegratorSpec& options, double step, const State& state) {
  const double acceleration = std::max(state.acceleration_scale(), size_of(model, state.algorithmic()));
  const double motion = share_of_motion * options.tolerance * step * step * acceleration;
  const double reach = reach_of(model, state) / model.length;
  const double round_off = 4.0 * std::numeric_limits<double>::epsilon();
  return {std::max(std::min(options.constraint_tolerance, motion), round_off * reach),
          std::min(options.constraint_tolerance, std::max(motion, round_off)) / step};
}

}  // namespace

double size_of(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& increment) {
  const int n = model.sizes.boundary;
  if (n == 0) return 0.0;
  return (increment.head(n).array().abs() / model.equation_scale.head(n)).maxCoeff<Eigen::PropagateNumbers>() /
         model.length;
}

Norms measure(const Model& model, const IntegratorSpec& options, double step, const State& state,
              Evaluation& evaluation) {
  Norms norms;
  double scale[3];
  for (int k = 0; k < 3; ++k) scale[k] = std::max(state.force_scale(k), evaluation.force_scale[k]);
  // Forces and moments are compared through the length, so that a scale of zero in one does not stall the test.
  const double force = std::max(scale[0], scale[1] / model.length);
  const double internal_ratio = 1.0 / (options.tolerance * std::max(scale[2], 1e-250));
  const double allowed = std::max(options.tolerance * force, force_round_off(model, state)) + 1e-300;
  if (model.sizes.boundary > 0)
    norms.residual = largest(evaluation.residual.array().abs() * model.equation_scale.head(model.sizes.boundary),
                             norms.worst_coordinate);
  norms.force_ratio = norms.residual / allowed;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const auto& r = evaluation.superelements[i].forces.r_I;
    for (int k = 0; k < r.size(); ++k)
      raise(norms.force_ratio, norms.worst_coordinate, std::abs(r[k]) * internal_ratio,
            model.sizes.boundary + model.internal_offset[i] + k);
    raise(norms.force_ratio, norms.worst_coordinate, evaluation.superelements[i].motion.frame_error / frame_tolerance,
          model.superelements.maps[i].coordinates.front());
  }
  const Closed closed = closed_constraints(model, options, step, state);
  const bool rates = options.formulation == Formulation::stabilised_index2;
  const double position_ratio = 1.0 / (closed.position * model.length), rate_ratio = 1.0 / (closed.rate * model.length);
  const double* in_length = model.equation_scale.data() + model.sizes.boundary;
  for (int row = 0; row < model.sizes.constraints; ++row) {
    const double violation = std::abs(evaluation.constraint[row]) * in_length[row];
    norms.constraint = std::max(norms.constraint, violation);
    if (evaluation.active[row] == 0.0) continue;
    raise(norms.constraint_ratio, norms.worst_constraint, violation * position_ratio, row);
    if (rates)
      raise(norms.constraint_ratio, norms.worst_constraint,
            std::abs(evaluation.constraint_rate[row]) * in_length[row] * rate_ratio, row);
  }
  return norms;
}

}  // namespace tisserand::mechanism

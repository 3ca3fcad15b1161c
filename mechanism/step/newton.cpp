// SPDX-License-Identifier: GPL-3.0-or-later
// Convergence, factors and solutions of one iteration.
#include "mechanism/step/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/round_off.hpp"

namespace tisserand::mechanism {
namespace {

using formats::Formulation;

/// Counts new factors. Returns false with the outcome if they are singular.
bool are_regular(const FactorReport& factors, Iteration& it) {
  ++it.report.factorisations;
  if (factors.regular && factors.reciprocal_condition >= singular_condition) return true;
  it.report.outcome = StepOutcome::singular;
  it.report.singular_column = factors.singular_column;
  return false;
}

/// Factors again at the state of the last evaluation. Returns false if singular.
bool refactor(Iteration& it) {
  return are_regular(it.workspace.matrix.factor(it.model, it.state, it.scheme.request, it.workspace.now), it);
}

/// Whether corrections with the kept factors of the position projection fail to close the constraints: the violation is
/// larger than after each of the last two iterations. After one iteration it can be small by chance.
bool projection_fails(const Iteration& it) {
  return it.scheme.projects && it.report.constraint_ratio > 1.0 &&
         it.report.constraint_ratio > std::max(it.last_constraint_ratio, it.earlier_constraint_ratio);
}

/// Factors the position projection at the state of the last evaluation. Returns false if singular.
bool renew_projection(Iteration& it) {
  return are_regular(renew_projection(it.model, it.state, it.scheme, it.workspace.now, it.workspace.memory.projection),
                     it);
}

bool contracts_slowly(const Iteration& it) {
  return it.increment > it.workspace.memory.tuning.slow_rate * it.last_increment;
}

/// Smallest increment above round-off: `increment_floor`, or the round-off of positions if that is larger, as at 1 km
/// from the origin.
double floor_of(const Iteration& it) {
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  return std::max(increment_floor, rounding * reach_of(it.model, it.state) / it.model.length);
}

/// Whether the last increment has reached round-off.
bool round_off(const Iteration& it) {
  const double floor = floor_of(it);
  if (size_of(it.model, it.workspace.matrix.correction) >= floor) return false;
  return it.increment < least_increment || (it.increment < floor && contracts_slowly(it));
}

void note(const Norms& norms, StepReport& report) {
  const bool force_is_worse = norms.force_ratio >= norms.constraint_ratio || !std::isfinite(norms.force_ratio);
  report.force_ratio = norms.force_ratio;
  report.constraint_ratio = norms.constraint_ratio;
  report.residual = norms.residual;
  report.constraint = norms.constraint;
  report.worst_coordinate = force_is_worse ? norms.worst_coordinate : -1;
  report.worst_constraint = force_is_worse ? -1 : norms.worst_constraint;
}

}  // namespace

bool change_step(Iteration& it) {
  State& state = it.state;
  if (state.step() == it.scheme.step) return true;
  const double ratio = state.step() > 0.0 ? it.scheme.step / state.step() : 1.0;
  rebuild_algorithmic_acceleration(it.scheme.step, state);
  if (ratio == 1.0 || it.options.formulation != Formulation::index3 || it.model.sizes.constraints == 0) return true;
  IterationMatrix& matrix = it.workspace.matrix;
  evaluate(it.model, state, it.workspace.now);
  if (!refactor(it)) return false;
  matrix.rows = (ratio * ratio - 1.0) * it.workspace.now.constraint_rate;
  matrix.solve_projection(it.model, matrix.rows, it.workspace.now);
  state.v() += matrix.correction;
  return true;
}

bool converged(Iteration& it) {
  const Norms norms = measure(it.model, it.options, it.scheme.step, it.state, it.workspace.now);
  note(norms, it.report);
  if (it.count > 0) {
    it.last_increment = it.increment;
    it.increment = size_of(it.model, it.workspace.matrix.increment);
  }
  if (!norms.finite()) {
    it.report.outcome = StepOutcome::diverged;
    return false;
  }
  if (norms.worst() <= 1.0) return true;
  // Kept factors do not test multipliers that move no body. Those of a plane mechanism that has turned by more than 60
  // degrees since would grow from step to step, while positions do not change.
  if (it.factors == Factors::fresh && round_off(it)) return true;
  if (it.count >= it.options.max_iterations) it.report.outcome = StepOutcome::too_many_iterations;
  return false;
}

bool ready_factors(Iteration& it) {
  if (it.factors == Factors::kept) return !contracts_slowly(it) && !round_off(it);
  const double quick_rate = it.workspace.memory.tuning.quick_rate;
  const bool quick = it.count > 0 && it.report.residual <= quick_rate * it.last_residual &&
                     it.report.constraint_ratio <= std::max(1.0, quick_rate * it.last_constraint_ratio);
  if (projection_fails(it) && !renew_projection(it)) return false;
  it.last_residual = it.report.residual;
  it.earlier_constraint_ratio = it.last_constraint_ratio;
  it.last_constraint_ratio = it.report.constraint_ratio;
  return quick || refactor(it);
}

void solve(Iteration& it) {
  const Evaluation& now = it.workspace.now;
  IterationMatrix& matrix = it.workspace.matrix;
  if (!it.scheme.projects) {
    matrix.rows = -now.constraint;
    matrix.solve_increment(it.model, matrix.rows, it.workspace.now);
    return;
  }
  PositionProjection& projection = it.workspace.memory.projection;
  matrix.rows = -it.scheme.request.rows.rate_factor * now.constraint_rate;
  matrix.solve_increment(it.model, matrix.rows, it.workspace.now);
  apply_jacobian(it.model, now, matrix.increment, projection.open);
  projection.open = -now.constraint - projection.open;
  project_positions(it.model, it.workspace.memory.tuning, now, projection, matrix.correction);
}

}  // namespace tisserand::mechanism

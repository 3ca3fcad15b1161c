// The time step as a page of verbs: predict, evaluate, check, solve, correct, accept.
#include "mechanism/step/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/newton.hpp"
#include "mechanism/step/convergence.hpp"
#include "mechanism/step/position_projection.hpp"
#include "mechanism/step/redundancy.hpp"
#include "mechanism/step/step_control.hpp"

namespace tisserand::mechanism {
namespace {

using formats::Formulation;
using formats::IntegratorSpec;

/// Increments below this, relative to the characteristic length and to one radian, may be round-off: they are where
/// they do not become smaller. They always are below the second.
constexpr double increment_floor = 1e-13;
constexpr double least_increment = 4e-16;
/// Relative difference up to which two steps are the same.
constexpr double same_step = 1e-9;
/// Kept factors are given up when an increment is not smaller than this times the one before.
constexpr double slow_rate = 0.25;
/// New factors serve the next iteration of the same step too if the residual fell below this times the one before.
constexpr double quick_rate = 0.02;
/// The motion is smooth if the last change of acceleration foretells the next one up to this part of it.
constexpr double smooth_rate = 0.5;
/// Factors that served this many steps are worth keeping.
constexpr int long_life = 8;
/// Most steps with new factors in every iteration before kept ones are tried again.
constexpr int longest_pause = 63;
/// Violation of rows that are left out, relative to the length, up to which they follow from the others.
constexpr double largest_left_out = 1e-7;
/// Smallest reciprocal condition with which a factorisation is used.
constexpr double singular_condition = 1e-17;

/// From the last accepted state, with velocities and algorithmic acceleration as this step needs them; the acceleration
/// stays, or changes on as in the last step where the motion is smooth.
void predict(const Model& model, const AlphaParameters& alpha, double step, State& state, Workspace& workspace) {
  workspace.displacement = step * state.v() + (0.5 * step * step) * state.algorithmic();
  workspace.correction.setZero();
  state.v() += step * state.algorithmic();
  state.vdot() = (state.algorithmic() - alpha.alpha_f * state.vdot()) / (1.0 - alpha.alpha_f);
  const Trend& trend = workspace.trend;
  if (trend.smooth && workspace.previous.step() == step) {
    state.lambda() += trend.multipliers;
    state.algorithmic() += trend.acceleration;
    state.v() += (alpha.gamma * step) * trend.acceleration;
    state.vdot() += ((1.0 - alpha.alpha_m) / (1.0 - alpha.alpha_f)) * trend.acceleration;
    workspace.displacement += (alpha.beta * step * step) * trend.acceleration;
  }
  retract(model, workspace.previous, workspace.displacement, state);
}

/// Learns from the step just solved how to predict the next one.
void update_trend(const Model& model, double step, const State& state, Workspace& workspace) {
  const State& last = workspace.previous;
  Trend& trend = workspace.trend;
  if (last.step() != step) {
    trend.known = trend.smooth = false;
    return;
  }
  // The largest change of an acceleration, rotations times the length; and what the change before leaves of it.
  double change = 0.0, rest = 0.0;
  for (int i = 0; i < model.sizes.boundary; ++i) {
    const double one = state.algorithmic()[i] - last.algorithmic()[i];
    change = std::max(change, std::abs(one) / model.equation_scale[i]);
    rest = std::max(rest, std::abs(one - trend.acceleration[i]) / model.equation_scale[i]);
  }
  trend.smooth = trend.known && rest < smooth_rate * change;
  trend.known = true;
  trend.acceleration = state.algorithmic() - last.algorithmic();
  trend.multipliers = state.lambda() - last.lambda();
}

/// Adds an increment of h² β a to acceleration, velocity and position, and a correction to the position alone.
void correct(const Model& model, const AlphaParameters& alpha, double step, State& state, Workspace& workspace) {
  const TangentCoefficients c = step_coefficients(alpha, step);
  state.algorithmic() += workspace.increment / (alpha.beta * step * step);
  state.v() += c.damping * workspace.increment;
  state.vdot() += c.mass * workspace.increment;
  workspace.displacement += workspace.increment + workspace.correction;
  state.lambda() += workspace.unknowns.tail(model.sizes.constraints);
  retract(model, workspace.previous, workspace.displacement, state);
}

/// Whether positions have corrections of their own.
bool closes_positions(const Model& model, const IntegratorSpec& options) {
  return options.formulation == Formulation::stabilised_index2 && model.sizes.constraints > 0;
}

/// Position and multiplier increments of one iteration; Φ (index 3) or B v and Φ (stabilised index 2) to zero.
void solve(const Model& model, const IntegratorSpec& options, const AlphaParameters& alpha, double step,
           Workspace& workspace) {
  if (!closes_positions(model, options)) {
    workspace.bias = -workspace.constraint;
    solve_increment(model, workspace.bias, workspace);
    return;
  }
  workspace.bias = -(alpha.beta * step / alpha.gamma) * workspace.constraint_rate;
  solve_increment(model, workspace.bias, workspace);
  apply_jacobian(model, workspace, workspace.increment, workspace.bias);
  workspace.bias = -workspace.constraint - workspace.bias;
  close_positions(model, workspace);
}

void accept(const Model& model, double step, State& state, Workspace& workspace) {
  auto Q = state.Q();
  for (Eigen::Index i = 0; i < Q.cols(); ++i) Q.col(i).normalize();
  auto frames = state.frames();
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    frames.col(i) = wxyz(Eigen::Quaterniond(workspace.superelements[i].motion.R0).normalized());
  unwrap_hinges(model, workspace, state);
  for (int k = 0; k < 3; ++k) state.force_scale(k) = std::max(state.force_scale(k), workspace.force_scale[k]);
  state.acceleration_scale() = std::max(state.acceleration_scale(), size_of(model, state.algorithmic()));
  state.work() += 0.5 * step * (state.load_power() + workspace.load_power);
  state.dissipated() += 0.5 * step * (state.damping_power() + workspace.damping_power);
  state.load_power() = workspace.load_power;
  state.damping_power() = workspace.damping_power;
}

/// The solution of a step becomes the state, unless its error is too large.
void finish(const Model& model, const IntegratorSpec& options, double step, State& state, Workspace& workspace,
            StepReport& report) {
  if (options.error_control.active) {
    estimate_error(options, step, state, workspace.previous, workspace.increment);
    const LocalError error = measure_error(model, options, step, workspace.increment);
    report.error_ratio = error.ratio;
    if (!(error.ratio <= 1.0)) {
      report.outcome = StepOutcome::inaccurate;
      report.worst_coordinate = error.worst_coordinate;
      report.worst_constraint = -1;
      state.block() = workspace.previous.block();
      return;
    }
  }
  // Index 3 doubly integrates what Newton leaves of its constraints: there a step has to end far below the tolerance,
  // as it does from the constant prediction.
  if (options.formulation == Formulation::stabilised_index2) {
    update_trend(model, step, state, workspace);
    age_closing(model, workspace);
  }
  accept(model, step, state, workspace);
}

/// What the factors of a step are made of.
struct IterationMatrix {
  TangentCoefficients coefficients;
  ConstraintRows rows;
};

IterationMatrix iteration_matrix(const IntegratorSpec& options, const AlphaParameters& alpha, double step) {
  const ConstraintRows rows = options.formulation == Formulation::index3
                                  ? ConstraintRows{ConstraintRows::Kind::position, 0.0}
                                  : ConstraintRows{ConstraintRows::Kind::velocity, alpha.beta * step / alpha.gamma};
  return {step_coefficients(alpha, step), rows};
}

/// Factors anew at the state of the last evaluate().
void renew(const Model& model, const IterationMatrix& matrix, const State& state, Workspace& workspace,
           StepReport& report) {
  const FactorReport factors = factor(model, state, matrix.coefficients, TangentKind::step, matrix.rows, workspace);
  ++report.factorisations;
  if (factors.regular && factors.reciprocal_condition >= singular_condition) return;
  report.outcome = StepOutcome::singular;
  report.singular_column = factors.singular_column;
}

enum class Factors { kept, fresh };

/// What stays the same during the iterations of one step.
struct Iteration {
  const Model& model;
  const IntegratorSpec& options;
  const AlphaParameters& alpha;
  IterationMatrix matrix;
  double step;
  StepEnd end;
};

/// Sizes of the last two increments of an iteration, infinite where there was none.
struct Increments {
  double now = std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();
  bool slow() const { return now > slow_rate * last; }
  bool round_off() const { return now < least_increment || (now < increment_floor && slow()); }
};

/// Notes the norms of the last evaluate() in the report; true if they, or the last increments, are small enough. Sets
/// the outcome when the iteration cannot go on.
bool converged(const Iteration& it, int iterations, const Increments& increments, const State& state,
               Workspace& workspace, StepReport& report) {
  const Norms norms = measure(it.model, it.options, it.step, state, workspace);
  const bool force_is_worse = norms.force_ratio >= norms.constraint_ratio || !std::isfinite(norms.force_ratio);
  report.force_ratio = norms.force_ratio;
  report.constraint_ratio = norms.constraint_ratio;
  report.residual = norms.residual;
  report.constraint = norms.constraint;
  report.worst_coordinate = force_is_worse ? norms.worst_coordinate : -1;
  report.worst_constraint = force_is_worse ? -1 : norms.worst_constraint;
  if (!norms.finite()) {
    report.outcome = StepOutcome::diverged;
    return false;
  }
  if (norms.worst() <= 1.0) return true;
  if (increments.round_off() && size_of(it.model, workspace.correction) < increment_floor) return true;
  if (iterations >= it.options.max_iterations) report.outcome = StepOutcome::too_many_iterations;
  return false;
}

/// Readies the last accepted state for a step of another size: the algorithmic acceleration is rebuilt, and with index
/// 3 the violation B v + Φ_t of the velocities, −C h² B v̈ in the settled motion of one step size, is brought to that of
/// the new one. Left as it was, it would throw the multipliers off by O(h) for many steps ("Index 3 and a change of
/// step" in DECISIONS.md). Positions stay, and velocities change by M⁻¹Bᵀ μ only. False: singular.
bool change_step(const Iteration& it, State& state, Workspace& workspace, StepReport& report) {
  const double ratio = state.step() > 0.0 ? it.step / state.step() : 1.0;
  rebuild_algorithmic_acceleration(it.step, state);
  if (ratio == 1.0 || it.options.formulation != Formulation::index3 || it.model.sizes.constraints == 0) return true;
  workspace.displacement.setZero();
  evaluate(it.model, state, workspace);
  renew(it.model, it.matrix, state, workspace, report);
  if (report.outcome != StepOutcome::accepted) return false;
  workspace.bias = (ratio * ratio - 1.0) * workspace.constraint_rate;
  solve_correction(it.model, workspace.bias, workspace);
  state.v() += workspace.correction;
  return true;
}

/// Newton's iteration from the prediction, with the factors that are there or with new ones (again in every iteration
/// that does not converge quickly). True if it converges. Gives up kept factors as soon as they contract slowly,
/// without an outcome of its own.
bool iterate(const Iteration& it, Factors factors, State& state, Workspace& workspace, StepReport& report) {
  state.block() = workspace.previous.block();
  if (state.step() != it.step && !change_step(it, state, workspace, report)) return false;
  state.time() = it.end.time;
  state.load_time() = it.end.load_time;
  predict(it.model, it.alpha, it.step, state, workspace);
  Increments increments;
  double last_residual = 0.0, last_constraint_ratio = 0.0;
  for (int count = 0;; ++count) {
    evaluate(it.model, state, workspace);
    if (count > 0) increments = {size_of(it.model, workspace.increment), increments.now};
    if (converged(it, count, increments, state, workspace, report)) return true;
    if (report.outcome != StepOutcome::accepted) return false;
    if (factors == Factors::fresh) {
      const bool quick = count > 0 && report.residual <= quick_rate * last_residual &&
                         report.constraint_ratio <= std::max(1.0, quick_rate * last_constraint_ratio);
      if (!quick) renew(it.model, it.matrix, state, workspace, report);
      if (report.outcome != StepOutcome::accepted) return false;
      last_residual = report.residual;
      last_constraint_ratio = report.constraint_ratio;
    } else if (increments.slow()) {
      return false;
    }
    solve(it.model, it.options, it.alpha, it.step, workspace);
    correct(it.model, it.alpha, it.step, state, workspace);
    ++report.iterations;
  }
}

}  // namespace

AlphaParameters alpha_parameters(const IntegratorSpec& spec) {
  AlphaParameters p;
  switch (spec.method) {
    case formats::Method::bdf:  // its start is that of generalised alpha
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

namespace {

/// A step with the constraint rows that the state says are solved for.
StepReport take_step(const Model& model, const IntegratorSpec& options, const StepEnd& end, State& state,
                     Workspace& workspace) {
  const AlphaParameters alpha = alpha_parameters(options);
  // Steps of one size differ in the last digits of their ends: they keep their factors.
  const double difference = end.time - state.time();
  const double step = std::abs(difference - state.step()) <= same_step * difference ? state.step() : difference;
  workspace.previous.block() = state.block();
  const Iteration iteration{model, options, alpha, iteration_matrix(options, alpha, step), step, end};

  StepReport report;
  if (closes_positions(model, options)) {
    const FactorReport factors = prepare_closing(model, state, iteration.matrix.coefficients, step, workspace);
    if (!factors.regular || factors.reciprocal_condition < singular_condition) {
      report.outcome = StepOutcome::singular;
      report.singular_column = factors.singular_column;
      return report;
    }
  }
  FactorReuse& reuse = workspace.reuse;
  const bool same = workspace.has_factors && workspace.factored == iteration.matrix.coefficients;
  if (same && reuse.fresh_left == 0) {
    if (iterate(iteration, Factors::kept, state, workspace, report)) {
      finish(model, options, step, state, workspace, report);
      ++reuse.kept;
      return report;
    }
    // Factors that age within a few steps are not worth keeping for a while.
    reuse.fresh = reuse.kept >= long_life ? 0 : std::min(2 * reuse.fresh + 1, longest_pause);
    reuse.fresh_left = reuse.fresh;
    reuse.kept = 0;
  } else if (same) {
    --reuse.fresh_left;
  }
  report.outcome = StepOutcome::accepted;
  if (iterate(iteration, Factors::fresh, state, workspace, report)) {
    finish(model, options, step, state, workspace, report);
    return report;
  }
  workspace.has_factors = false;
  state.block() = workspace.previous.block();
  return report;
}

/// After a doubtful step: back to where it began, with other rows to solve for. Those that are independent there, for
/// the old ones may have become dependent on the way and the end of the step satisfies nothing; if that says no more
/// than was known (the step left a position of lower rank), those that are independent where it ended. False, and the
/// state as it was, if they stay.
bool choose_rows_again(const Model& model, State& state, Workspace& workspace) {
  const State end = state;
  state.block() = workspace.previous.block();
  if (!choose_active_rows(model, state, workspace) || state.active().sum() < end.active().sum()) {
    state.block() = end.block();
    if (!choose_active_rows(model, state, workspace)) return false;
    const Eigen::VectorXd rows = state.active();
    state.block() = workspace.previous.block();
    state.active() = rows;
  }
  workspace.forget();
  return true;
}

}  // namespace

StepReport advance(const Model& model, const IntegratorSpec& options, const StepEnd& end, State& state,
                   Workspace& workspace) {
  const StepReport report = take_step(model, options, end, state, workspace);
  const bool is_accepted = report.outcome == StepOutcome::accepted;
  const bool is_doubtful = is_accepted ? largest_violation_left_out(model, workspace) > largest_left_out
                                       : is_overconstrained(state) || report.outcome == StepOutcome::singular;
  if (report.outcome == StepOutcome::inaccurate || !is_doubtful || !choose_rows_again(model, state, workspace))
    return report;
  StepReport again = take_step(model, options, end, state, workspace);
  again.iterations += report.iterations;
  again.factorisations += report.factorisations;
  again.row_choices = 1;
  return again;
}

void rebuild_algorithmic_acceleration(double step, State& state) {
  if (state.step() > 0.0)
    state.algorithmic() = state.vdot() + (step / state.step()) * (state.algorithmic() - state.vdot());
  state.step() = step;
}

std::string explain(const Model& model, const StepReport& report) {
  std::string place;
  if (report.outcome == StepOutcome::singular && report.singular_column >= 0)
    place = report.singular_column < model.sizes.boundary
                ? coordinate_name(model, report.singular_column)
                : constraint_name(model, report.singular_column - model.sizes.boundary);
  else if (report.worst_constraint >= 0)
    place = constraint_name(model, report.worst_constraint);
  else if (report.worst_coordinate >= 0)
    place = coordinate_name(model, report.worst_coordinate);
  switch (report.outcome) {
    case StepOutcome::accepted:
      return "accepted";
    case StepOutcome::inaccurate:
      return fmt::format("the local error is {:.2g} times the tolerance, worst at {}", report.error_ratio, place);
    case StepOutcome::singular:
      return fmt::format(
          "the iteration matrix is singular{}{}: a direction without mass, stiffness or constraint, or "
          "redundant constraints",
          place.empty() ? "" : " at ", place);
    case StepOutcome::diverged:
      return fmt::format(
          "the iteration left the range of numbers, first at {}: the step is too long for the motion, or "
          "a load is not finite",
          place);
    case StepOutcome::too_many_iterations:
      return fmt::format(
          "Newton's iteration does not converge, worst at {} (residual {:.1e} times the tolerance, "
          "constraint {:.1e} times): the step is too long, or parts turn so far that their elements are "
          "no longer small",
          place, report.force_ratio, report.constraint_ratio);
  }
  return {};
}

}  // namespace tisserand::mechanism

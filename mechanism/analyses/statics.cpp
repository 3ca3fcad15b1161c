// SPDX-License-Identifier: GPL-3.0-or-later
// Load steps around Newton's iteration.
#include "mechanism/analyses/statics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mechanism/analyses/steady_rotation.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/equations/round_off.hpp"

namespace tisserand::mechanism {
namespace {

/// Largest magnitude; NaN if any entry is not finite (a maximum would drop it).
double largest_of(const Eigen::Ref<const Eigen::VectorXd>& values) {
  if (!values.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0;
}

double largest_residual(const Model& model, const Workspace& workspace) {
  return largest_of(workspace.now.residual.cwiseProduct(model.equation_scale.matrix().head(model.sizes.boundary)));
}

/// Whether forces on internal coordinates are below `least`, or below `force` on a mode of its body, whose shape has
/// the size 1/√mass. Where a load does not excite the modes, their own forces are round-off.
bool internal_balance(const Model& model, const Workspace& workspace, double least, double force) {
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const double r = largest_of(workspace.now.superelements[i].forces.r_I);
    if (!(r <= std::max(least, force / std::sqrt(body_of(model, i).mass)))) return false;
  }
  return true;
}

/// Brings a state to rest; during its lifetime tangents hold tyres in place.
class Standing {
 public:
  Standing(State& state, Evaluation& evaluation) : evaluation_(evaluation) {
    state.v().setZero();
    state.vdot().setZero();
    evaluation_.standing = true;
  }
  ~Standing() { evaluation_.standing = false; }
  Standing(const Standing&) = delete;
  Standing& operator=(const Standing&) = delete;

 private:
  Evaluation& evaluation_;
};

/// Factors the stiffness at the evaluated state. Returns the name of a free motion, or an empty text.
std::string free_direction(const Model& model, const State& state, Workspace& workspace) {
  const FactorReport factors =
      workspace.matrix.factor(model, state, {{0.0, 0.0, 1.0}, TangentKind::exact, {}}, workspace.now);
  if (factors.regular && factors.reciprocal_condition >= free_motion_condition) return {};
  if (factors.singular_column >= 0 && factors.singular_column < model.sizes.boundary)
    return coordinate_name(model, factors.singular_column);
  return factors.regular ? workspace.matrix.weakest_equation(model) : std::string("a rigid motion");
}

/// Whether forces and constraints of the last evaluate() balance.
bool in_balance(EquilibriumSearch& search) {
  auto& [model, options, interrupted, state, workspace, report] = search;
  report.residual = largest_residual(model, workspace);
  report.constraint = largest_of(workspace.now.constraint);
  const double internal =
      std::max(options.tolerance * workspace.now.force_scale[2], internal_round_off(model, workspace.now));
  return report.residual <= allowed_force(model, state, workspace.now, options.tolerance) &&
         internal_balance(model, workspace, internal, options.tolerance * force_size(model, workspace.now)) &&
         report.constraint <= options.tolerance * model.length;
}

/// Newton's iteration at one load factor.
StepOutcome equilibrate(EquilibriumSearch& search) {
  auto& [model, options, interrupted, state, workspace, report] = search;
  for (int iteration = 0;; ++iteration) {
    evaluate(model, state, workspace.now);
    const bool balanced = in_balance(search);
    if (iteration > 0 && balanced) return StepOutcome::accepted;
    if (!std::isfinite(report.residual)) return StepOutcome::diverged;
    report.interrupted = interrupted && interrupted();
    if (iteration == options.max_iterations || report.interrupted) return StepOutcome::too_many_iterations;
    report.explanation = free_direction(model, state, workspace);
    // Only the first state shows a free motion; a later one may be singular because the load step is too long.
    if (!report.explanation.empty()) return iteration == 0 ? StepOutcome::singular : StepOutcome::diverged;
    workspace.matrix.solve_increment(model, -workspace.now.constraint, workspace.now);
    state.lambda() += workspace.matrix.multipliers;
    const State before = state;
    retract(model, before, workspace.matrix.increment, state);
    ++report.iterations;
  }
}

/// Takes the positions of the last evaluate() as the reference of floating frames and angles.
void accept_equilibrium(const Model& model, State& state, const Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    state.frames().col(i) = wxyz(Eigen::Quaterniond(evaluation.superelements[i].motion.R0).normalized());
  for (Eigen::Index i = 0; i < state.Q().cols(); ++i) state.Q().col(i).normalize();
  unwrap_hinges(model, evaluation, state);
}

/// Completes the explanation of a failure: `reached` is the part of the load, `step` the smallest load step.
void explain_statics(double reached, double step, StaticsReport& report) {
  if (report.outcome == StepOutcome::singular)
    report.explanation = reached == 0.0
                             ? fmt::format("the scene can move freely: nothing holds {}", report.explanation)
                             : fmt::format("the structure loses its stability at {:.3g} of the load: nothing holds {}",
                                           reached, report.explanation);
  if (report.outcome == StepOutcome::diverged || report.outcome == StepOutcome::too_many_iterations)
    report.explanation = fmt::format(
        "no equilibrium was found beyond {:.3g} of the load (residual {:.2e}, smallest load step "
        "{:.2g}): the load is too large, or the structure loses its stability",
        reached, report.residual, step);
}

/// Counts the negative directions at the end of a load step.
void judge(const Model& model, const State& state, Evaluation& evaluation, StaticsReport& report) {
  const double reached = evaluation.load_factor;
  report.stability = stability_of(model, state, evaluation, reached == 1.0);
  if (report.unstable_from > 1.0 && report.stability.unstable > 0)
    report.unstable_from = reached;
  else if (report.unstable_from > 1.0)
    report.stable_until = reached;
}

/// Goes from the present state to an equilibrium without negative directions, under the whole load.
DescentReport descend(EquilibriumSearch& search) {
  search.workspace.now.load_factor = 1.0;
  const DescentReport descent = descend(
      search.model, [&] { return in_balance(search); }, search.interrupted, search.state, search.workspace.now);
  search.report.descents += descent.iterations;
  search.report.iterations += descent.iterations;
  return descent;
}

/// Ramps loads and gravity (the load factor) from zero to one. Load steps are halved where no equilibrium is found. A
/// failure is explained in the report. The load factor is one at the end.
void ramp_loads(EquilibriumSearch& search) {
  auto& [model, options, interrupted, state, workspace, report] = search;
  double reached = 0.0;
  double size = 1.0 / std::max(1, options.load_steps);
  int halvings = 0;
  constexpr int most_halvings = 12;
  constexpr double round_off = 1e-12;  // of a sum of load steps: ten times 0.1 is less than 1
  while (reached < 1.0) {
    const State before = state;
    workspace.now.load_factor = reached + size < 1.0 - round_off ? reached + size : 1.0;
    report.outcome = options.rotation ? balance_turning(search) : equilibrate(search);
    if (report.outcome == StepOutcome::accepted) {
      reached = workspace.now.load_factor;
      accept_equilibrium(model, state, workspace.now);
      ++report.load_steps;
      if (!options.rotation) judge(model, state, workspace.now, report);
      continue;
    }
    state = before;
    if (report.interrupted || report.outcome == StepOutcome::singular || ++halvings > most_halvings) break;
    size *= 0.5;
  }
  workspace.now.load_factor = 1.0;
  explain_statics(reached, size, report);
}

/// Name of the joint coordinate or node that moves most in a free motion of the state, or empty. The state is at rest,
/// or in the steady rotation of the options, in which centrifugal forces hold too.
std::string free_motion(const Model& model, const formats::StaticsSpec& options, State state, Workspace& workspace) {
  // The matrices are dense. In larger scenes the sparse factors or the solution name the free motion.
  constexpr int most_named = 600;
  const bool small = model.sizes.velocities() <= most_named;
  if (options.rotation) {
    const std::string turn = free_turn_name(model, *options.rotation, state, workspace.now);
    return turn.empty() && small ? free_motion_name(model, *options.rotation, state, workspace.now) : turn;
  }
  const Standing standing(state, workspace.now);
  evaluate(model, state, workspace.now);
  const std::string direction = free_direction(model, state, workspace);
  if (direction.empty() || !small) return direction;
  const std::string name = free_motion_name(model, {}, state, workspace.now);
  return name.empty() ? direction : name;
}

}  // namespace

Settled settle_under_load(const Model& model, const formats::StaticsSpec& options, const Interrupt& interrupted,
                          State& state, Workspace& workspace) {
  const std::string free = free_motion(model, options, state, workspace);
  if (free.empty() || options.rotation) return {free};
  const Standing standing(state, workspace.now);
  const State begin = state;
  EquilibriumSearch search{model, options, interrupted, state, workspace};
  const DescentReport descent = descend(search);
  if (descent.found) return {{}, descent.iterations};
  state.block() = begin.block();
  return {descent.direction.empty() ? free : descent.direction};
}

StaticsReport solve_statics(const Model& model, const formats::StaticsSpec& options, const Interrupt& interrupted,
                            State& state, Workspace& workspace) {
  EquilibriumSearch search{model, options, interrupted, state, workspace};
  StaticsReport& report = search.report;
  if (options.rotation) {
    ramp_loads(search);
    return report;
  }
  const Standing standing(state, workspace.now);
  ramp_loads(search);
  const bool failed = report.outcome == StepOutcome::diverged || report.outcome == StepOutcome::too_many_iterations;
  // Search for a stable equilibrium if it is required, or if Newton's iteration finds none, as from a slack cable. If
  // the stiffness became singular on the way, load steps were halved until no load was left that holds the scene.
  const bool lost = failed || (report.outcome == StepOutcome::singular && report.iterations > 0);
  if (!report.interrupted && (lost || (options.stable && report.stability.unstable > 0))) {
    if (descend(search).found) {
      accept_equilibrium(model, state, workspace.now);
      report.outcome = StepOutcome::accepted;
      report.load_steps += lost;
      report.explanation.clear();
      report.stability = stability_of(model, state, workspace.now, true);
      return report;
    }
  }
  if (failed && !model.tyres.empty())
    report.explanation +=
        "; in statics, tyres have no force along the road: on a slope, hold the vehicle with a drive or a spring";
  return report;
}

}  // namespace tisserand::mechanism

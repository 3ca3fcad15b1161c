// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's iteration on the constraints, and the linear systems for rates and multipliers.
#include "mechanism/analyses/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/analyses/linearise.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/equations/carriers.hpp"
#include "mechanism/equations/constraint_rows.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/model/bodies.hpp"

namespace tisserand::mechanism {
namespace {

/// Smallest reciprocal condition of [M Bᵀ; B 0] at which the constraints determine the motion.
constexpr double dead_point = 1e-15;
/// Increments below this, relative to length or one radian, are round-off.
constexpr double increment_floor = 1e-14;
/// Largest gap of an inactive row, relative to the length. A larger one shows that the rank has changed.
constexpr double left_open = 1e-7;

/// Factors [M Bᵀ; B 0] at the state of the last evaluate().
FactorReport factor_constraints(const Model& model, const State& state, Workspace& workspace) {
  FactorReport report = workspace.matrix.factor(model, state, {{1.0, 0.0, 0.0}, TangentKind::step, {}}, workspace.now);
  report.regular = report.regular && report.reciprocal_condition > dead_point;
  return report;
}

StepOutcome close_gaps(const Model& model, const formats::IntegratorSpec& options, State& state, Workspace& workspace,
                       StepReport& report) {
  const double round_off = 4.0 * std::numeric_limits<double>::epsilon() * reach_of(model, state);  // of positions
  const double allowed = std::max(options.constraint_tolerance, round_off / model.length);
  const double floor = std::max(increment_floor * model.length, round_off);
  for (;; ++report.iterations) {
    evaluate(model, state, workspace.now);
    report.constraint = largest_violation(model, workspace.now, Rows::solved).value;
    if (!std::isfinite(report.constraint)) return StepOutcome::diverged;
    const bool met = report.constraint <= allowed;
    const bool still = report.iterations > 0 && workspace.matrix.correction.cwiseAbs().maxCoeff() < floor;
    if (met && (report.iterations > 1 || report.constraint < 1e-15 || still)) return StepOutcome::accepted;
    if (report.iterations >= options.max_iterations || still) return StepOutcome::too_many_iterations;
    const FactorReport factors = factor_constraints(model, state, workspace);
    ++report.factorisations;
    report.singular_column = factors.singular_column;
    if (!factors.regular) return StepOutcome::singular;
    workspace.matrix.solve_projection(model, -workspace.now.constraint, workspace.now);
    const State before = state;
    retract(model, before, workspace.matrix.correction, state);
  }
}

/// Name of the joint coordinate that moves most in a motion d (velocity coordinates, after evaluate_coordinates()), or
/// of the node.
std::string name_of_motion(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& d) {
  double largest = 0.0;
  std::string name;
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    const ElementMap& map = model.coordinates.maps[i];
    double rate = 0.0;
    for_each_entry(model, map, evaluation.coordinates[i].G, evaluation,
                   [&](int at, double value) { rate += value * d[at]; });
    if (is_length(model.coordinates[i].relation)) rate /= model.length;
    if (std::abs(rate) <= std::max(1e-9 * d.cwiseAbs().maxCoeff(), (1.0 + 1e-9) * largest)) continue;
    largest = std::abs(rate);
    name = fmt::format("coordinate '{}'", model.coordinates[i].name);
  }
  if (!name.empty()) return name;
  Eigen::Index at = 0;
  d.cwiseAbs().maxCoeff(&at);
  return coordinate_name(model, static_cast<int>(at));
}

void find_active_rows(const Model& model, State& state, Workspace& workspace) {
  state.active().setOnes();
  for (const int row : count_mobility(model, state, workspace.now).redundant) state.active()[row] = 0.0;
}

}  // namespace

std::string name_of_direction(const Model& model, const State& state, const Eigen::VectorXd& xi,
                              Evaluation& evaluation) {
  evaluate_coordinates(model, state, evaluation);
  return name_of_motion(model, evaluation, material_increment(model, evaluation, xi));
}

void require_determined(const Model& model, const Mobility& mobility, const std::string& where, const State& state,
                        Workspace& workspace) {
  std::string flexible;
  for_each_body(model, [&]<class Body>(const Body& body) {
    bool deforms = is_flexible(body);
    if constexpr (std::is_same_v<Body, ModalBody>) deforms = body.modes > 0;
    if (flexible.empty() && deforms) flexible = fmt::format("body '{}'", name_of(model, body));
  });
  if (!flexible.empty())
    throw Error(fmt::format("{} is flexible, but kinematics does not compute deformations", flexible), where,
                "write `effects: {flexibility: off}`; or use superelements with `use: rigid`, modal bodies with "
                "`modes: 0` and rigid bodies instead of beams; or run dynamics");
  if (mobility.degrees_of_freedom == 0) return;
  std::vector<std::string> names;
  if (model.sizes.velocities() <= most_linearised) {
    const Eigen::MatrixXd Z = null_space(model, active_jacobian(model, state, workspace.now));
    evaluate_coordinates(model, state, workspace.now);
    for (Eigen::Index k = 0; k < Z.cols(); ++k) {
      const std::string name = name_of_motion(model, workspace.now, Z.col(k));
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  throw Error(fmt::format("{} degrees of freedom are not driven{}{}", mobility.degrees_of_freedom,
                          names.empty() ? "" : "; free: ", listed(names)),
              where, "drive them under `motions:`, hold them with joints, or run dynamics");
}

bool solve_rates(const Model& model, State& state, Workspace& workspace) {
  evaluate(model, state, workspace.now);
  if (!factor_constraints(model, state, workspace).regular) return false;
  for (int refinement = 0; refinement < 2; ++refinement) {
    workspace.matrix.solve_projection(model, -workspace.now.constraint_rate, workspace.now);
    state.v() += workspace.matrix.correction;
    evaluate(model, state, workspace.now);
  }
  evaluate_bias(model, workspace.now);
  const Eigen::VectorXd bias = workspace.now.bias;
  for (int refinement = 0; refinement < 2; ++refinement) {
    apply_jacobian(model, workspace.now, state.vdot(), workspace.matrix.rows);
    workspace.matrix.solve_projection(model, -bias - workspace.matrix.rows, workspace.now);
    state.vdot() += workspace.matrix.correction;
  }
  evaluate(model, state, workspace.now);
  return state.v().allFinite() && state.vdot().allFinite();
}

bool solve_multipliers(const Model& model, State& state, Workspace& workspace) {
  for (Eigen::Index row = 0; row < state.lambda().size(); ++row)
    if (state.active()[row] == 0.0) state.lambda()[row] = 0.0;
  evaluate(model, state, workspace.now);
  if (!factor_constraints(model, state, workspace).regular) return false;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.sizes.constraints);
  // Friction depends on the multipliers and needs Newton's iteration. Otherwise one refinement is enough.
  constexpr int most_refinements = 50;
  const bool rubs = !model.frictions.empty();
  bool settled = !rubs;
  for (int refinement = 0; refinement < (rubs ? most_refinements : 2); ++refinement) {
    if (refinement > 0 && rubs && !factor_constraints(model, state, workspace).regular) return false;
    workspace.matrix.solve_increment(model, none, workspace.now);
    state.lambda() += workspace.matrix.multipliers;
    evaluate(model, state, workspace.now);
    settled = settled || workspace.matrix.multipliers.norm() <= 1e-12 * state.lambda().norm();
    if (rubs && settled) break;
  }
  return settled && state.lambda().allFinite();
}

StepReport move_along(const Model& model, const formats::IntegratorSpec& options, const StepEnd& end, State& state,
                      Workspace& workspace) {
  StepReport report;
  workspace.memory.previous.block() = state.block();
  const double h = end.time - state.time();
  const Eigen::VectorXd d = h * state.v() + (0.5 * h * h) * state.vdot();
  retract(model, workspace.memory.previous, d, state);
  state.v() += h * state.vdot();
  state.time() = end.time;
  state.load_time() = end.load_time;
  report.outcome = close_gaps(model, options, state, workspace, report);
  const bool other_rank = report.outcome == StepOutcome::singular ||
                          (report.outcome == StepOutcome::accepted &&
                           largest_violation(model, workspace.now, Rows::left_out).value > left_open);
  if (other_rank) {
    find_active_rows(model, state, workspace);
    report.iterations = 0;
    report.outcome = close_gaps(model, options, state, workspace, report);
    // If a row is inactive again although it is open, the drives do not determine the motion here.
    if (report.outcome == StepOutcome::accepted &&
        largest_violation(model, workspace.now, Rows::left_out).value > left_open)
      report.outcome = StepOutcome::singular;
  }
  if (report.outcome == StepOutcome::accepted && !solve_rates(model, state, workspace))
    report.outcome = StepOutcome::singular;
  if (report.outcome != StepOutcome::accepted) {
    state.block() = workspace.memory.previous.block();
    return report;
  }
  auto Q = state.Q();
  for (Eigen::Index i = 0; i < Q.cols(); ++i) Q.col(i).normalize();
  unwrap_hinges(model, workspace.now, state);
  return report;
}

}  // namespace tisserand::mechanism

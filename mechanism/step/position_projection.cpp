// SPDX-License-Identifier: GPL-3.0-or-later
// Weight of the projection, its factors and their age.
#include "mechanism/step/position_projection.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mechanism/equations/increments.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

/// Weight of every direction relative to the largest, for those without mass and stiffness. It is above round-off of
/// the factors, and far below any body of the same mechanism (mass ratio 1e10).
constexpr double least_weight = 1e-12;

/// No constraint holds a massless coordinate that yields to a force by more than this (1 is about the heaviest body,
/// 1e12 the least weight). Only the least weight would then bound the effect of (B₀ − B_m)ᵀμ₁ on it.
constexpr double most_give = 1e4;

bool serves(const PositionProjection& projection, double step) {
  return projection.has_factors() && !projection.renewed && projection.age < 1.0 && step <= 2.0 * projection.step &&
         projection.step <= 2.0 * step;
}

/// Adds the least weight to all coordinates. Finds the rotations of bodies with mass.
void weigh(const Model& model, PositionProjection& projection) {
  std::vector<double>& values = projection.system->matrix.values;
  const auto weight = [&](int i) -> double& { return values[model.pattern->slot(i, i)]; };
  projection.turns.setZero();
  for (const Node& node : model.nodes)
    for (int k = 3; k < 6; ++k)
      if (const int i = coordinate_of(model, node, k); i >= 0 && weight(i) != 0.0) projection.turns[i] = 1.0;
  for (int i = 0; i < model.sizes.boundary; ++i) {
    projection.held[i] = weight(i) != 0.0;
    weight(i) += least_weight / (model.equation_scale[i] * model.equation_scale[i]);
  }
}

/// Finds the massless coordinates that constraints hold. Those that yield to forces on all of them are not held.
void find_held(const Model& model, PositionProjection& projection) {
  const int n = model.sizes.boundary;
  if (projection.held.minCoeff() > 0.0) return;
  SaddleSystem& system = *projection.system;
  system.unknowns.setZero();
  for (int i = 0; i < n; ++i)  // of different sizes, so that they cancel along no direction
    if (projection.held[i] == 0.0) system.unknowns[i] = (1.0 + std::fmod(0.618 * i, 1.0)) / model.equation_scale[i];
  system.solve(model);
  for (int i = 0; i < n; ++i)
    if (std::abs(system.unknowns[i]) <= most_give * model.equation_scale[i]) projection.held[i] = 1.0;
}

/// Positions of B₀ᵀ in the matrix.
std::vector<PositionProjection::Entry> entries_of_rows(const Model& model) {
  std::vector<PositionProjection::Entry> entries;
  for (int row = 0; row < model.sizes.constraints; ++row)
    model.pattern->for_each_in(model.sizes.boundary + row, [&](int i, int slot) {
      if (i < model.sizes.boundary) entries.push_back({slot, i, row, 0.0});
    });
  return entries;
}

/// Stores B₀ of the matrix that was made for the factors.
void keep_rows(const Model& model, PositionProjection& projection) {
  const std::vector<double>& values = projection.system->matrix.values;
  for (PositionProjection::Entry& entry : projection.entries)
    entry.value = values[entry.slot] / model.value_scale[entry.slot];
}

/// Scales μ₁ to a step of this length. δ, and with it μ over the scale of the matrix, grows with the cube of the step.
void expect(double step, PositionProjection& projection) {
  projection.taken = step;
  if (projection.expected_step == 0.0) return;
  const double ratio = step / projection.expected_step;
  if (ratio != 1.0) projection.expected *= ratio * ratio * ratio;
  projection.expected_step = step;
  projection.old.setZero();
  for (const PositionProjection::Entry& entry : projection.entries)
    projection.old[entry.coordinate] += entry.value * projection.expected[entry.row];
}

/// Sets the upper rows to what the direction of the middle of the step requires beyond what they have received. B is
/// assumed to turn evenly from B₀ to that of the last evaluate().
void turn_direction(const Model& model, const Evaluation& evaluation, PositionProjection& projection) {
  apply_transposed_jacobian(model, evaluation, projection.expected, projection.turned);
  const double share = (projection.elapsed + 0.5 * projection.taken) / (projection.elapsed + projection.taken);
  projection.turned = share * projection.held.cwiseProduct(projection.old - projection.turned);
  projection.system->unknowns.head(model.sizes.boundary) = projection.turned - projection.upper;
  projection.upper = projection.turned;
}

/// Angle [rad] by which bodies turn in the step so far.
double turn_of_step(const Model& model, const Evaluation& evaluation, const PositionProjection& projection) {
  return evaluation.displacement.head(model.sizes.boundary).cwiseProduct(projection.turns).lpNorm<Eigen::Infinity>();
}

FactorReport make_factors(const Model& model, const State& state, const StepScheme& scheme, Evaluation& evaluation,
                          PositionProjection& projection) {
  const TangentCoefficients& c = scheme.request.coefficients;
  evaluate_weight(model, state, {c.mass, 0.0, c.stiffness}, evaluation, projection.system->matrix);
  weigh(model, projection);
  const FactorReport report = projection.system->factor(model);
  projection.step = report.regular ? scheme.step : 0.0;
  projection.age = 0.0;
  projection.elapsed = 0.0;
  if (!report.regular) return report;
  keep_rows(model, projection);
  find_held(model, projection);
  return report;
}

}  // namespace

void PositionProjection::forget() {
  if (system) system->forget();
  step = 0.0;
  expected_step = 0.0;
  renewed = false;
}

FactorReport prepare_projection(const Model& model, const State& state, const StepScheme& scheme,
                                Evaluation& evaluation, PositionProjection& projection) {
  if (serves(projection, scheme.step)) {
    expect(scheme.step, projection);
    return {true, 1.0, -1, 1.0};
  }
  if (!projection.system) {
    projection.system.emplace(model);
    projection.entries = entries_of_rows(model);
    projection.turns.setZero(model.sizes.boundary);
    projection.open.setZero(model.sizes.constraints);
    projection.closed.setZero(model.sizes.constraints);
    projection.multipliers = projection.expected = projection.closed;
    projection.old = projection.turned = projection.upper = projection.held = projection.turns;
  }
  evaluate(model, state, evaluation);
  const FactorReport report = make_factors(model, state, scheme, evaluation, projection);
  if (report.regular) expect(scheme.step, projection);
  return report;
}

FactorReport renew_projection(const Model& model, const State& state, const StepScheme& scheme, Evaluation& evaluation,
                              PositionProjection& projection) {
  const FactorReport report = make_factors(model, state, scheme, evaluation, projection);
  projection.expected_step = 0.0;
  projection.renewed = true;
  start_projection(projection);
  return report;
}

void start_projection(PositionProjection& projection) {
  projection.multipliers.setZero();
  projection.upper.setZero();
}

void project_positions(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                       PositionProjection& projection, Eigen::VectorXd& correction) {
  const int n = model.sizes.boundary;
  SaddleSystem& system = *projection.system;
  const double share = projection.age * tuning.farthest_turn + turn_of_step(model, evaluation, projection);
  correction.setZero();
  double open = 1.0;
  for (int solution = 1;; ++solution) {
    if (solution == 1 && projection.expected_step > 0.0)
      turn_direction(model, evaluation, projection);
    else
      system.unknowns.head(n).setZero();
    system.unknowns.tail(model.sizes.constraints) = projection.open.cwiseProduct(evaluation.active);
    system.solve(model);
    correction.head(n) += system.unknowns.head(n);
    projection.multipliers += system.unknowns.tail(model.sizes.constraints);
    open *= share;
    if (open <= tuning.open_share || solution == tuning.most_projections) return;
    apply_jacobian(model, evaluation, system.unknowns, projection.closed);
    projection.open -= projection.closed;
  }
}

void age_projection(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                    PositionProjection& projection) {
  if (!projection.has_factors()) return;
  if (projection.renewed) return projection.forget();
  projection.age +=
      std::max(turn_of_step(model, evaluation, projection) / tuning.farthest_turn, 1.0 / tuning.most_steps);
  projection.elapsed += projection.taken;
  projection.expected = projection.multipliers;
  projection.expected_step = projection.taken;
}

}  // namespace tisserand::mechanism

// Weight, factors and their age.
#include "mechanism/step/position_projection.hpp"

#include <algorithm>

#include "mechanism/equations/increments.hpp"

namespace tisserand::mechanism {
namespace {

/// Weight of every direction, for those without mass and stiffness, relative to the largest: above round-off of the
/// factors, and far below any body of the same mechanism (mass ratio 1e10).
constexpr double least_weight = 1e-12;

bool serves(const PositionProjection& projection, double step) {
  return projection.has_factors() && projection.age < 1.0 && step <= 2.0 * projection.step &&
         projection.step <= 2.0 * step;
}

/// The least weight for all coordinates; and which of them turn a body with mass.
void weigh(const Model& model, PositionProjection& projection) {
  std::vector<double>& values = projection.system->matrix.values;
  const auto weight = [&](int i) -> double& { return values[model.pattern->slot(i, i)]; };
  projection.turns.setZero();
  for (const Node& node : model.nodes)
    for (int k = 0; k < 3 && node.rotation >= 0; ++k)
      if (weight(node.rotation + k) != 0.0) projection.turns[node.rotation + k] = 1.0;
  for (int i = 0; i < model.sizes.boundary; ++i)
    weight(i) += least_weight / (model.equation_scale[i] * model.equation_scale[i]);
}

/// Radians by which bodies turn in the step so far.
double turn_of_step(const Model& model, const Evaluation& evaluation, const PositionProjection& projection) {
  return evaluation.displacement.head(model.sizes.boundary).cwiseProduct(projection.turns).lpNorm<Eigen::Infinity>();
}

}  // namespace

void PositionProjection::forget() {
  if (system) system->forget();
  step = 0.0;
}

FactorReport prepare_projection(const Model& model, const State& state, const StepScheme& scheme,
                                Evaluation& evaluation, PositionProjection& projection) {
  if (serves(projection, scheme.step)) return {true, 1.0, -1, 1.0};
  if (!projection.system) {
    projection.system.emplace(model);
    projection.turns.setZero(model.sizes.boundary);
    projection.open.setZero(model.sizes.constraints);
    projection.closed.setZero(model.sizes.constraints);
  }
  evaluate(model, state, evaluation);
  const TangentCoefficients& c = scheme.request.coefficients;
  evaluate_weight(model, state, {c.mass, 0.0, c.stiffness}, evaluation, projection.system->matrix);
  weigh(model, projection);
  const FactorReport report = projection.system->factor(model);
  projection.step = report.regular ? scheme.step : 0.0;
  projection.age = 0.0;
  return report;
}

void project_positions(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                       PositionProjection& projection, Eigen::VectorXd& correction) {
  const int n = model.sizes.boundary;
  SaddleSystem& system = *projection.system;
  const double share = projection.age * tuning.farthest_turn + turn_of_step(model, evaluation, projection);
  correction.setZero();
  double open = 1.0;
  for (int solution = 1;; ++solution) {
    system.unknowns.head(n).setZero();
    system.unknowns.tail(model.sizes.constraints) = projection.open.cwiseProduct(evaluation.active);
    system.solve(model);
    correction.head(n) += system.unknowns.head(n);
    open *= share;
    if (open <= tuning.open_share || solution == tuning.most_projections) return;
    apply_jacobian(model, evaluation, system.unknowns, projection.closed);
    projection.open -= projection.closed;
  }
}

void age_projection(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                    PositionProjection& projection) {
  if (!projection.has_factors()) return;
  projection.age +=
      std::max(turn_of_step(model, evaluation, projection) / tuning.farthest_turn, 1.0 / tuning.most_steps);
}

}  // namespace tisserand::mechanism

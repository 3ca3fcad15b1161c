// Weight, factors and their age.
#include "mechanism/step/position_projection.hpp"

#include <algorithm>

#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/newton.hpp"

namespace tisserand::mechanism {
namespace {

/// Radians that bodies may turn on one W⁻¹Bᵀ, and steps that it may serve.
constexpr double farthest = 0.1;
constexpr double most_steps = 16.0;
/// Weight of every direction, for those without mass and stiffness, relative to the largest.
constexpr double least_weight = 1e-12;
/// A solution leaves open the share by which B has turned since; they are repeated until less than this is left.
constexpr double open_share = 0.15;
constexpr int most_solutions = 4;

bool serves(const Closing& closing, double step) {
  return closing.step > 0.0 && closing.age < 1.0 && step <= 2.0 * closing.step && closing.step <= 2.0 * step;
}

/// The least weight for all coordinates; and which of them turn a body with mass.
void weigh(const Model& model, Closing& closing) {
  const auto weight = [&](int i) -> double& { return closing.values[model.pattern->slot(i, i)]; };
  closing.turns.setZero();
  for (const Node& node : model.nodes)
    for (int k = 0; k < 3 && node.rotation >= 0; ++k)
      if (weight(node.rotation + k) != 0.0) closing.turns[node.rotation + k] = 1.0;
  for (int i = 0; i < model.sizes.boundary; ++i)
    weight(i) += least_weight / (model.equation_scale[i] * model.equation_scale[i]);
}

/// Radians by which bodies turn in the step so far.
double turn_of_step(const Model& model, const Workspace& workspace) {
  const Eigen::VectorXd& turns = workspace.closing.turns;
  return workspace.displacement.head(model.sizes.boundary).cwiseProduct(turns).lpNorm<Eigen::Infinity>();
}

}  // namespace

FactorReport prepare_closing(const Model& model, const State& state, const TangentCoefficients& coefficients,
                             double step, Workspace& workspace) {
  Closing& closing = workspace.closing;
  if (serves(closing, step)) return {true, 1.0, -1, 1.0};
  if (!closing.solver) {
    closing.solver.emplace(*model.pattern, model.solver.kind);
    closing.values.resize(workspace.values.size());
    closing.turns.setZero(model.sizes.boundary);
    closing.unknowns.setZero(model.pattern->size());
    closing.product.setZero(model.sizes.constraints);
  }
  workspace.displacement.setZero();
  evaluate(model, state, workspace);
  evaluate_weight(model, state, {coefficients.mass, 0.0, coefficients.stiffness}, workspace, closing.values);
  weigh(model, closing);
  Eigen::Map<Eigen::ArrayXd>(closing.values.data(), model.value_scale.size()) *= model.value_scale;
  const FactorReport report = closing.solver->numeric(closing.values);
  closing.step = report.regular ? step : 0.0;
  closing.age = 0.0;
  return report;
}

void close_positions(const Model& model, Workspace& workspace) {
  Closing& closing = workspace.closing;
  const int n = model.sizes.boundary;
  const double share = closing.age * farthest + turn_of_step(model, workspace);
  workspace.correction.setZero();
  double open = 1.0;
  for (int solution = 1;; ++solution) {
    Eigen::VectorXd& unknowns = closing.unknowns;
    unknowns.head(n).setZero();
    unknowns.tail(model.sizes.constraints) = workspace.bias.cwiseProduct(workspace.active);
    unknowns.array() *= model.equation_scale;
    closing.solver->solve({unknowns.data(), static_cast<std::size_t>(unknowns.size())});
    unknowns.array() *= model.equation_scale;
    workspace.correction.head(n) += unknowns.head(n);
    open *= share;
    if (open <= open_share || solution == most_solutions) return;
    apply_jacobian(model, workspace, unknowns, closing.product);
    workspace.bias -= closing.product;
  }
}

void age_closing(const Model& model, Workspace& workspace) {
  Closing& closing = workspace.closing;
  if (closing.step == 0.0) return;
  closing.age += std::max(turn_of_step(model, workspace) / farthest, 1.0 / most_steps);
}

}  // namespace tisserand::mechanism

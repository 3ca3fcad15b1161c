// SPDX-License-Identifier: GPL-3.0-or-later
// Round-off of positions and rotations, and its effect through the generalised strains.
#include "mechanism/equations/round_off.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tisserand::mechanism {
namespace {
constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
/// Round-off of reactions relative to the forces of the scene, for a condition 1e3 of the mass matrix.
constexpr double reaction_round_off = 1e-12;

template <class Counts>
Violation largest_where(const Model& model, const Eigen::VectorXd& rows, Counts counts) {
  Violation worst;
  for (int row = 0; row < model.sizes.constraints && !std::isnan(worst.value); ++row)
    if (counts(row))
      if (const double value = violation_of(model, rows, row); !(value <= worst.value)) worst = {value, row};
  return worst;
}

}  // namespace

double reach_of(const Model& model, const State& state) {
  return state.x().cols() > 0 ? std::max(model.length, state.x().cwiseAbs().maxCoeff()) : model.length;
}

double force_round_off(const Model& model, const State& state) {
  return rounding * model.stiffness_scale * reach_of(model, state);
}

double force_size(const Model& model, const Evaluation& evaluation) {
  return std::max(evaluation.force_scale[0], evaluation.force_scale[1] / model.length);
}

double allowed_force(const Model& model, const State& state, const Evaluation& evaluation, double share) {
  return std::max(share * force_size(model, evaluation), force_round_off(model, state));
}

double violation_of(const Model& model, const Eigen::VectorXd& rows, int row) {
  return std::abs(rows[row]) / (model.length_row[row] ? model.length : 1.0);
}

Violation largest_violation(const Model& model, const Eigen::VectorXd& rows) {
  return largest_where(model, rows, [](int) { return true; });
}

Violation largest_violation(const Model& model, const Evaluation& evaluation, Rows kind) {
  const double active = kind == Rows::solved ? 1.0 : 0.0;
  return largest_where(model, evaluation.constraint, [&](int row) { return evaluation.active[row] == active; });
}

bool is_round_off(const Model& model, const State& state, const Evaluation& evaluation,
                  const Eigen::Ref<const Eigen::VectorXd>& multipliers) {
  if (multipliers.size() == 0) return true;
  const auto in_length = model.equation_scale.segment(model.sizes.boundary, multipliers.size());
  const double largest = (multipliers.array().abs() / in_length).maxCoeff<Eigen::PropagateNaN>();
  return largest <= allowed_force(model, state, evaluation, reaction_round_off);
}

double internal_round_off(const Model& model, std::size_t superelement, const Evaluation& evaluation) {
  const SuperelementBody& body = body_of(model, superelement);
  if (!body.second_order.stiffening) return 0.0;
  const auto& reach = body.second_order.stiffening->reach;
  const auto& h = evaluation.superelements[superelement].forces.strain.h;
  double largest = 0.0;
  const double reach_of_body =
      std::max(model.length, nodes_of(model, superelement, evaluation)[0].x.cwiseAbs().maxCoeff());
  for (Eigen::Index k = body.boundary_size; k < h.cols(); ++k) {
    double force = 0.0;
    for (Eigen::Index a = 0; a < h.rows(); ++a)
      force += std::abs(h(a, k)) * (reach_of_body * reach(a, 0) + reach(a, 1));
    largest = std::max(largest, force);
  }
  return rounding * largest;
}

double internal_round_off(const Model& model, const Evaluation& evaluation) {
  double largest = 0.0;
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    largest = std::max(largest, internal_round_off(model, i, evaluation));
  return largest;
}

}  // namespace tisserand::mechanism

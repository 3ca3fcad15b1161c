// SPDX-License-Identifier: GPL-3.0-or-later
// Poses at the start, and one evaluation of them.
#include "mechanism/build/initial_state.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/equations/tangent.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

/// Measures angles at the start, and the constants that are values at the start.
void measure_start(Model& model, State& state, Evaluation& evaluation) {
  evaluate(model, state, evaluation);
  unwrap_hinges(model, evaluation, state);
  update_modal_nodes(model, evaluation);
  evaluate_coordinates(model, state, evaluation);
  for (Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms)
      if (coupling.from_start) coupling.constant += term.factor * evaluation.coordinates[term.coordinate].value;
  for (Spring& spring : model.springs)
    if (spring.free_at_start) spring.free = evaluation.coordinates[spring.coordinate].value;
  for (std::size_t i = 0; i < model.bushings.size(); ++i)
    if (model.bushings[i].free_at_start) model.bushings[i].free = evaluation.bushings[i].deflection;
}

/// Sets the scales of the iteration matrix: largest diagonal entries of mass and stiffness.
void scale(Model& model, const State& state, Evaluation& evaluation) {
  evaluate(model, state, evaluation);
  MatrixValues matrix(model);
  const auto largest_diagonal = [&](const TangentCoefficients& c) {
    model.mass_scale = model.stiffness_scale = 1.0;
    evaluate_tangent(model, state, {c, TangentKind::step, {}}, evaluation, matrix);
    double largest = 0.0;
    for (int i = 0; i < model.sizes.boundary; ++i) {
      const int slot = model.pattern->slot(i, i);
      largest = std::max(largest, std::abs(matrix.values[slot]) * model.value_scale[slot]);
    }
    return largest;
  };
  const double mass = largest_diagonal({1.0, 0.0, 0.0});
  const double stiffness = largest_diagonal({0.0, 0.0, 1.0});
  model.mass_scale = mass > 0.0 ? mass : 1.0;
  model.stiffness_scale = stiffness;
}

}  // namespace

State initial_state(const Construction& c, Model& model) {
  State state(model.sizes);
  state.time() = state.load_time() = c.scene.integrator.start;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const NodeMotion& m = c.markers.start[i];
    const auto column = static_cast<Eigen::Index>(i);
    state.x().col(column) = m.x;
    state.Q().col(column) = wxyz(Eigen::Quaterniond(m.R).normalized());
    if (model.nodes[i].translation >= 0) set_translation(model, m.xd, model.nodes[i].translation, state.v());
    if (model.nodes[i].rotation >= 0) set_rotation(model, m.Omega, model.nodes[i].rotation, state.v());
  }
  for (std::size_t i = 0; i < c.frames.size(); ++i) state.frames().col(i) = wxyz(c.frames[i]);
  Evaluation evaluation(model);
  measure_start(model, state, evaluation);
  scale(model, state, evaluation);
  return state;
}

}  // namespace tisserand::mechanism

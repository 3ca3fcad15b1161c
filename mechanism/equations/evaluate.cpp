// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluation of a model at a state in order: motion, constraints, forces.
#include "mechanism/equations/evaluate.hpp"

#include <limits>

#include "mechanism/equations/bodies.hpp"
#include "mechanism/equations/forces.hpp"
#include "mechanism/model/bodies.hpp"
#include "mechanism/model/forces.hpp"

namespace tisserand::mechanism {
namespace {

/// Sets results of another state to NaN if assertions are enabled.
void forget_results([[maybe_unused]] Evaluation& evaluation) {
#ifndef NDEBUG
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (Eigen::VectorXd* result : {&evaluation.constraint, &evaluation.constraint_rate, &evaluation.bias,
                                  &evaluation.active, &evaluation.residual})
    result->setConstant(unknown);
  evaluation.force_scale.fill(unknown);
  evaluation.outer_force = evaluation.load_power = evaluation.damper_power = evaluation.body_power = evaluation.spring_energy = unknown;
#endif
  evaluation.stage = Stage::nothing;
}

void clear_forces(Evaluation& evaluation) {
  evaluation.residual.setZero();
  evaluation.force_scale.fill(0.0);
  evaluation.load_power = evaluation.damper_power = evaluation.body_power = evaluation.spring_energy = 0.0;
}

}  // namespace

void evaluate_motion(const Model& model, const State& state, Evaluation& evaluation) {
  forget_results(evaluation);
  update_motion(model, state, evaluation);
  update_modal_bodies(model, state, evaluation);
  evaluation.stage = Stage::motion;
}

void evaluate_constraints(const Model& model, const State& state, Evaluation& evaluation) {
  evaluate_motion(model, state, evaluation);
  evaluation.active = state.active();
  update_joints(model, evaluation);
  update_coordinates(model, state, evaluation);
  update_channels(model, evaluation);
  update_couplings(model, state, evaluation);
  evaluation.stage = Stage::constraints;
}

void evaluate_in_step(const Model& model, const State& state, Evaluation& evaluation) {
  evaluate_constraints(model, state, evaluation);
  clear_forces(evaluation);
  update_part_loads(model, state, evaluation);
  for_each_body_pool(model, [&](const auto& pool) { add_forces(model, state, pool, evaluation); });  // G_iner + G_int
  add_joints(model, state, evaluation);
  add_frictions(model, state, evaluation);
  add_couplings(model, state, evaluation);
  add_springs(model, state, evaluation);
  for_each_force_pool(model, [&](const auto& pool) { add_forces(model, state, pool, evaluation); });
  note_modes(model, evaluation);
  evaluation.stage = Stage::forces;
}

void evaluate(const Model& model, const State& state, Evaluation& evaluation) {
  evaluation.displacement.setZero();
  evaluate_in_step(model, state, evaluation);
}

Energy evaluate_energy(const Model& model, const Evaluation& evaluation) {
  require_stage(evaluation, Stage::forces);
  Energy sum{.strain = evaluation.spring_energy};
  for_each_body_pool(model, [&](const auto& pool) { add_energy(model, pool, evaluation, sum); });
  return sum;
}

}  // namespace tisserand::mechanism

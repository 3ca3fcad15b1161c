// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the terms of evaluate(), pool by pool.
#include "mechanism/equations/tangent.hpp"

#include <algorithm>
#include <type_traits>

#include "mechanism/equations/bodies.hpp"
#include "mechanism/equations/forces.hpp"
#include "mechanism/model/bodies.hpp"
#include "mechanism/model/forces.hpp"

namespace tisserand::mechanism {
namespace {

/// Sets rows and columns of inactive constraints to δλ = 0.
void deactivate_rows(const Model& model, const State& state, std::vector<double>& values) {
  const SparsePattern& pattern = *model.pattern;
  for (int row = 0; row < model.sizes.constraints; ++row) {
    if (state.active()[row] != 0.0) continue;
    const int j = model.sizes.boundary + row;
    pattern.for_each_in(j, [&](int i, int slot) { values[slot] = values[pattern.slot(j, i)] = 0.0; });
    values[pattern.slot(j, j)] = 1.0;
  }
}

/// Sets all values to zero and chooses their scale.
TangentTarget clear(const Model& model, const TangentCoefficients& coefficients, const ConstraintRows& rows,
                    Evaluation& evaluation, MatrixValues& matrix) {
  matrix.scale = coefficients.mass * model.mass_scale + coefficients.stiffness * model.stiffness_scale;
  if (!(matrix.scale > 0.0)) matrix.scale = 1.0;  // damping alone, or no stiffness
  std::fill(matrix.values.begin(), matrix.values.end(), 0.0);
  return {coefficients, rows, 1.0 / matrix.scale, matrix.values, evaluation.carriers};
}

/// Adds the tangents of bodies without internal coordinates.
void add_body_tangents(const Model& model, TangentKind kind, Evaluation& evaluation, const TangentTarget& target) {
  for_each_body_pool(model, [&]<class T>(const Pool<T>& pool) {
    if constexpr (!std::is_same_v<T, SuperelementUse>) add_tangents(model, pool, kind, evaluation, target);
  });
}

/// Adds the tangents of bodies, joints, friction, coordinates and forces without internal coordinates.
void add_node_tangents(const Model& model, const State& state, TangentKind kind, Evaluation& evaluation,
                       const TangentTarget& target) {
  add_body_tangents(model, kind, evaluation, target);
  add_joint_tangents(model, state, evaluation, target);
  add_friction_tangents(model, state, evaluation, target);
  add_coordinate_tangents(model, state, evaluation, target);
  for_each_force_pool(model, [&](const auto& pool) { add_tangents(model, pool, evaluation, target); });
  add_channel_tangents(model, state, evaluation, target);
}

}  // namespace

void evaluate_tangent(const Model& model, const State& state, const TangentRequest& request, Evaluation& evaluation,
                      MatrixValues& matrix) {
  require_stage(evaluation, Stage::forces);
  ++evaluation.tangents;
  const TangentTarget target = clear(model, request.coefficients, request.rows, evaluation, matrix);
  add_tangents(model, model.superelements, request.kind, evaluation, target);
  add_node_tangents(model, state, request.kind, evaluation, target);
  deactivate_rows(model, state, matrix.values);
}

void evaluate_tangent_without_superelements(const Model& model, const State& state, const TangentRequest& request,
                                            Evaluation& evaluation, MatrixValues& matrix) {
  require_stage(evaluation, Stage::forces);
  const TangentTarget target = clear(model, request.coefficients, request.rows, evaluation, matrix);
  add_node_tangents(model, state, request.kind, evaluation, target);
  deactivate_rows(model, state, matrix.values);
}

void evaluate_weight(const Model& model, const State& state, const TangentCoefficients& coefficients,
                     Evaluation& evaluation, MatrixValues& matrix) {
  require_stage(evaluation, Stage::forces);
  const ConstraintRows rows;
  const TangentTarget bodies = clear(model, coefficients, rows, evaluation, matrix);
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    SuperelementWork& work = work_of(model, i, evaluation);
    boundary_weight(body_of(model, i), coefficients, evaluation.superelements[i], work);
    scatter_matrix(model.superelements.maps[i], work.A_BB, bodies.factor, matrix.values);
  }
  add_body_tangents(model, TangentKind::step, evaluation, bodies);
  for (std::size_t i = 0; i < model.tyres.size(); ++i) {
    if (!model.tyres[i].relaxes()) continue;
    Matrix8d mass = Matrix8d::Zero();
    mass.diagonal().tail<2>().setConstant(coefficients.mass * lag_mass(model.tyres[i]));
    scatter_matrix(model.tyres.maps[i], mass, bodies.factor, matrix.values);
  }
  const TangentTarget rows_alone{coefficients, rows, 0.0, matrix.values, evaluation.carriers};
  add_joint_tangents(model, state, evaluation, rows_alone);
  add_coordinate_tangents(model, state, evaluation, rows_alone);
  deactivate_rows(model, state, matrix.values);
}

}  // namespace tisserand::mechanism

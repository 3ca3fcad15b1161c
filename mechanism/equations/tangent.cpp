// Derivatives of the terms of evaluate(), pool by pool.
#include "mechanism/equations/tangent.hpp"

#include <algorithm>

#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

/// Rows and columns of constraints that others imply: δλ = 0.
void deactivate_rows(const Model& model, const State& state, std::vector<double>& values) {
  const SparsePattern& pattern = *model.pattern;
  for (int row = 0; row < model.sizes.constraints; ++row) {
    if (state.active()[row] != 0.0) continue;
    const int j = model.sizes.boundary + row;
    for (int at = pattern.column_start()[j]; at < pattern.column_start()[j + 1]; ++at) {
      const int i = pattern.rows()[at];
      values[pattern.slot(i, j)] = 0.0;
      values[pattern.slot(j, i)] = 0.0;
    }
    values[pattern.slot(j, j)] = 1.0;
  }
}

template <class Pool>
void add_beam_tangents(const Pool& beams, const std::vector<ElementMap>& maps, const Evaluation& evaluation,
                       const TangentTarget& target) {
  constexpr int n = Pool::value_type::dofs;
  Eigen::Matrix<double, n, 1> r;
  Eigen::Matrix<double, n, n> A;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    residual_and_tangent(beams[i], evaluation.motion, beams[i].gravity, target.coefficients, r, A);
    scatter_matrix(maps[i], A, target.factor, target.values);
  }
}

/// Sets all values to zero and chooses their scale.
TangentTarget clear(const Model& model, const TangentCoefficients& coefficients, const ConstraintRows& rows,
                    MatrixValues& matrix) {
  matrix.scale = coefficients.mass * model.mass_scale + coefficients.stiffness * model.stiffness_scale;
  if (!(matrix.scale > 0.0)) matrix.scale = 1.0;  // damping alone, or no stiffness
  std::fill(matrix.values.begin(), matrix.values.end(), 0.0);
  return {coefficients, rows, 1.0 / matrix.scale, matrix.values};
}

/// Of bodies without internal coordinates.
void add_body_tangents(const Model& model, Evaluation& evaluation, const TangentTarget& target) {
  add_beam_tangents(model.beams2, model.beam2_maps, evaluation, target);
  add_beam_tangents(model.beams3, model.beam3_maps, evaluation, target);
  Matrix6d A;
  for (std::size_t i = 0; i < model.rigid_bodies.size(); ++i) {
    tangent(model.rigid_bodies[i], motion_of(evaluation, model.rigid_bodies[i].node), target.coefficients, A);
    scatter_matrix(model.rigid_maps[i], A, target.factor, target.values);
  }
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    tangent(model.modal_bodies[i], target.coefficients, evaluation.modal_bodies[i]);
    scatter_matrix(model.modal_maps[i], evaluation.modal_bodies[i].tangent, target.factor, target.values);
  }
}

void add_load_tangents(const Model& model, Evaluation& evaluation, const TangentTarget& target) {
  Matrix6d A;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const NodeMotion& node = motion_of(evaluation, load.at.node);
    A = load_stiffness(load, node, evaluation.load_values[i]);
    add_matrix(model, model.load_maps[i], A, -target.coefficients.stiffness * target.factor, evaluation, target.values,
               [&] { return load_force(load, node, evaluation.load_values[i]); });
  }
}

/// Of everything that acts on nodes without internal coordinates.
void add_node_tangents(const Model& model, const State& state, Evaluation& evaluation, const TangentTarget& target) {
  add_body_tangents(model, evaluation, target);
  add_load_tangents(model, evaluation, target);
  add_joint_tangents(model, state, evaluation, target);
  add_friction_tangents(model, state, evaluation, target);
  add_coordinate_tangents(model, state, evaluation, target);
  add_bushing_tangents(model, evaluation, target);
  add_channel_tangents(model, state, evaluation, target);
}

}  // namespace

void evaluate_tangent(const Model& model, const State& state, const TangentRequest& request, Evaluation& evaluation,
                      MatrixValues& matrix) {
  require_stage(evaluation, Stage::forces);
  const TangentTarget target = clear(model, request.coefficients, request.rows, matrix);
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    SuperelementScratch& scratch = evaluation.superelements[i];
    SuperelementWork& work = work_of(model, i, evaluation);
    switch (request.kind) {
      case TangentKind::step:
        tangent(body_of(model, i), request.coefficients, scratch, work);
        break;
      case TangentKind::exact:
        exact_tangent(body_of(model, i), nodes_of(model, i, evaluation),
                      evaluation.load_factor * model.superelements[i].gravity, request.coefficients, scratch, work);
        break;
    }
    scatter_matrix(model.superelement_maps[i], work.A_BB, target.factor, target.values);
  }
  add_node_tangents(model, state, evaluation, target);
  deactivate_rows(model, state, matrix.values);
}

void evaluate_tangent_without_superelements(const Model& model, const State& state,
                                            const TangentCoefficients& coefficients, Evaluation& evaluation,
                                            MatrixValues& matrix) {
  require_stage(evaluation, Stage::forces);
  const ConstraintRows rows;
  add_node_tangents(model, state, evaluation, clear(model, coefficients, rows, matrix));
  deactivate_rows(model, state, matrix.values);
}

void evaluate_weight(const Model& model, const State& state, const TangentCoefficients& coefficients,
                     Evaluation& evaluation, MatrixValues& matrix) {
  require_stage(evaluation, Stage::forces);
  const ConstraintRows rows;
  const TangentTarget bodies = clear(model, coefficients, rows, matrix);
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    SuperelementWork& work = work_of(model, i, evaluation);
    boundary_weight(body_of(model, i), coefficients, evaluation.superelements[i], work);
    scatter_matrix(model.superelement_maps[i], work.A_BB, bodies.factor, matrix.values);
  }
  add_body_tangents(model, evaluation, bodies);
  const TangentTarget rows_alone{coefficients, rows, 0.0, matrix.values};
  add_joint_tangents(model, state, evaluation, rows_alone);
  add_coordinate_tangents(model, state, evaluation, rows_alone);
  deactivate_rows(model, state, matrix.values);
}

}  // namespace tisserand::mechanism

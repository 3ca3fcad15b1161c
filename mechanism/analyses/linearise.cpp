// SPDX-License-Identifier: GPL-3.0-or-later
// Exact tangents of a state as dense matrices, in axes that may rotate.
#include "mechanism/analyses/linearise.hpp"

#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/terms.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Adds the blocks of one superelement, with its internal coordinates.
void add_superelement(const Model& model, std::size_t i, const TangentCoefficients& c, const Evaluation& evaluation,
                      MatrixXd& A) {
  const SuperelementBody& body = body_of(model, i);
  MatrixXd local;
  const Vector3d gravity = evaluation.load_factor * model.superelements[i].gravity;
  whole_exact_tangent(body, evaluation.superelements[i], nodes_of(model, i, evaluation), gravity, c, local);
  std::vector<int> rows = model.superelements.maps[i].coordinates;
  for (int k = 0; k < body.modes; ++k) rows.push_back(model.sizes.boundary + model.internal_offset[i] + k);
  for (Eigen::Index column = 0; column < local.cols(); ++column)
    for (Eigen::Index row = 0; row < local.rows(); ++row) A(rows[row], rows[column]) += local(row, column);
}

/// Adds the derivatives of channels in the factors of part loads to the rows of internal coordinates.
void add_internal_loads(const Model& model, const State& state, const TangentCoefficients& c, Evaluation& evaluation,
                        MatrixXd& A) {
  for (std::size_t use = 0; use < model.channel_uses.size(); ++use) {
    const auto at = static_cast<std::size_t>(model.channel_uses[use].index);
    if (model.channel_uses[use].owner != ChannelUse::Owner::part_load) continue;
    const int superelement = model.part_loads[at].superelement;
    if (superelement < 0) continue;
    update_direction(model, at, evaluation);
    const PartLoadDirection& direction = evaluation.part_load_directions[at];
    const MatrixXd row = part_load_channel_row(model, state, use, c, evaluation);
    const int first = model.sizes.boundary + model.internal_offset[superelement];
    const int* columns = model.channel_uses.maps[use].coordinates.data() + direction.boundary.size();
    for (Eigen::Index j = 0; j < row.cols(); ++j)
      if (columns[j] >= 0)
        A.col(columns[j]).segment(first, direction.internal.size()) -= row(0, j) * direction.internal;
  }
}

/// The matrix c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q; `matrix` receives the values of the pattern.
MatrixXd exact_matrix(const Model& model, const State& state, const TangentCoefficients& c, Evaluation& evaluation,
                      MatrixValues& matrix) {
  const int n = model.sizes.velocities(), boundary = model.sizes.boundary;
  MatrixXd A = MatrixXd::Zero(n, n);
  evaluate_tangent_without_superelements(model, state, {c, TangentKind::exact, {}}, evaluation, matrix);
  for (int j = 0; j < boundary; ++j)
    model.pattern->for_each_in(j, [&](int i, int slot) {
      if (i < boundary) A(i, j) = matrix.scale * matrix.values[slot];
    });
  for (std::size_t i = 0; i < model.superelements.size(); ++i) add_superelement(model, i, c, evaluation, A);
  add_internal_loads(model, state, c, evaluation, A);
  return A;
}

/// Indices of active constraints, in the order of the rows of B.
std::vector<int> active_rows(const State& state) {
  std::vector<int> kept;
  for (int row = 0; row < std::ssize(state.active()); ++row)
    if (state.active()[row] != 0.0) kept.push_back(row);
  return kept;
}

/// Jacobian B from the values of a tangent.
MatrixXd jacobian(const Model& model, const State& state, const MatrixValues& matrix) {
  const int boundary = model.sizes.boundary;
  MatrixXd B = MatrixXd::Zero(model.sizes.constraints, model.sizes.velocities());
  for (int j = 0; j < boundary; ++j)
    model.pattern->for_each_in(j, [&](int i, int slot) {
      if (i >= boundary) B(i - boundary, j) = matrix.values[slot];
    });
  return B(active_rows(state), Eigen::all);
}

/// Replaces the columns of a node's translations or rotations in each matrix, from r(q, v, v̇) to (ξ, ξ', ξ''): δq = T0
/// ξ, δv = T0 ξ' + T01 ξ, δv̇ = T0 ξ'' + T11 ξ' + T12 ξ.
struct Columns {
  Matrix3d T0, T01, T11, T12;
};

void transform(int column, int count, const Columns& t, Linearisation& l) {
  const auto part = [count](const Matrix3d& T) { return T.topLeftCorner(count, count); };
  const MatrixXd M = l.M.middleCols(column, count), C = l.C.middleCols(column, count),
                 K = l.K.middleCols(column, count);
  l.M.middleCols(column, count) = M * part(t.T0);
  l.C.middleCols(column, count) = M * part(t.T11) + C * part(t.T0);
  l.K.middleCols(column, count) = M * part(t.T12) + C * part(t.T01) + K * part(t.T0);
  l.B.middleCols(column, count) = (l.B.middleCols(column, count) * part(t.T0)).eval();
}

void turn_rows(int row, const Matrix3d& R, Linearisation& l) {
  for (MatrixXd* A : {&l.M, &l.C, &l.K})
    if (A->size() > 0) A->middleRows<3>(row) = (R * A->middleRows<3>(row)).eval();
  l.r.segment<3>(row) = (R * l.r.segment<3>(row)).eval();
}

/// Evaluates the state and fills r.
Linearisation begin(const Model& model, const State& state, Evaluation& evaluation) {
  const int n = model.sizes.velocities();
  if (n > most_linearised)
    throw Error(
        fmt::format("the linearised matrices are dense: the model has {} coordinates, but at most {} are possible", n,
                    most_linearised),
        model.name, "use fewer elements, or superelements instead of beams");
  evaluate(model, state, evaluation);
  Linearisation l;
  l.r.resize(n);
  gather_residual(model, evaluation, l.r);
  return l;
}

}  // namespace

MatrixXd active_jacobian(const Model& model, const State& state, Evaluation& evaluation) {
  evaluate(model, state, evaluation);
  MatrixValues matrix(model);
  evaluate_tangent_without_superelements(model, state, {{0.0, 0.0, 1.0}, TangentKind::exact, {}}, evaluation, matrix);
  return jacobian(model, state, matrix);
}

Eigen::VectorXd active_part(const State& state, const Eigen::Ref<const Eigen::VectorXd>& of_constraints) {
  return of_constraints(active_rows(state));
}

void add_to_multipliers(const Eigen::VectorXd& values, State& state) {
  const std::vector<int> rows = active_rows(state);
  for (std::size_t row = 0; row < rows.size(); ++row)
    state.lambda()[rows[row]] += values[static_cast<Eigen::Index>(row)];
}

Linearisation linearise(const Model& model, const State& state, const Vector3d& omega, Evaluation& evaluation) {
  Linearisation l = begin(model, state, evaluation);
  MatrixValues matrix(model);
  l.M = exact_matrix(model, state, {1.0, 0.0, 0.0}, evaluation, matrix);
  l.C = exact_matrix(model, state, {0.0, 1.0, 0.0}, evaluation, matrix);
  l.K = exact_matrix(model, state, {0.0, 0.0, 1.0}, evaluation, matrix);
  l.B = jacobian(model, state, matrix);
  const Matrix3d W = skew<double>(omega), one = Matrix3d::Identity();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    const NodeMotion& motion = evaluation.motion[i];
    if (node.translation >= 0) transform(node.translation, translations_of(model), {one, W, 2.0 * W, W * W}, l);
    if (node.rotation < 0 || model.planar) continue;  // parallel axes: R = 1, and no terms arise
    const Matrix3d RT = motion.R.transpose(), spin = skew<double>(motion.Omega) * RT;
    transform(node.rotation, 3, {RT, RT * W, 2.0 * RT * W - spin, RT * W * W - spin * W}, l);
    turn_rows(node.rotation, motion.R, l);
  }
  return l;
}

Linearisation linearise_stiffness(const Model& model, const State& state, Evaluation& evaluation) {
  Linearisation l = begin(model, state, evaluation);
  MatrixValues matrix(model);
  l.K = exact_matrix(model, state, {0.0, 0.0, 1.0}, evaluation, matrix);
  l.B = jacobian(model, state, matrix);
  if (model.planar) return l;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const int row = model.nodes[i].rotation;
    if (row < 0) continue;
    const Matrix3d& R = evaluation.motion[i].R;
    for (MatrixXd* A : {&l.K, &l.B}) A->middleCols<3>(row) = (A->middleCols<3>(row) * R.transpose()).eval();
    turn_rows(row, R, l);
  }
  return l;
}

Eigen::VectorXd material_increment(const Model& model, const Evaluation& evaluation, Eigen::VectorXd xi) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (const int row = model.nodes[i].rotation; row >= 0)
      set_rotation(model, evaluation.motion[i].R.transpose() * rotation_at(model, xi, row), row, xi);
  return xi;
}

void move_by(const Model& model, const Eigen::VectorXd& xi, const Eigen::VectorXd& multipliers,
             const Evaluation& evaluation, State& state) {
  const State before = state;
  retract(model, before, material_increment(model, evaluation, xi), state);
  add_to_multipliers(multipliers, state);
}

}  // namespace tisserand::mechanism

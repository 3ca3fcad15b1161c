// SPDX-License-Identifier: GPL-3.0-or-later
// Random states, the dense iteration matrix and differences of the residual.
#include "tests/support/scenes/model_tangent.hpp"

#include <random>

#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"

namespace tisserand::test_support {

void randomise(Simulation& run, unsigned seed, double turn, double size) {
  std::mt19937 random(seed);
  mechanism::State& state = run.state();
  const mechanism::State before = state;
  mechanism::retract(run.model(), before, random_vector_n(random, state.v().size(), turn), state);
  state.v() = random_vector_n(random, state.v().size(), size);
  state.vdot() = random_vector_n(random, state.v().size(), size);
  state.lambda() = random_vector_n(random, state.lambda().size(), size);
}

Eigen::MatrixXd dense_matrix(Simulation& run, const mechanism::TangentRequest& request) {
  return dense_matrix(run, run.state(), request);
}

Eigen::MatrixXd dense_matrix(Simulation& run, const mechanism::State& state, const mechanism::TangentRequest& request) {
  mechanism::MatrixValues matrix(run.model());
  mechanism::evaluate_tangent(run.model(), state, request, run.workspace.now, matrix);
  const mechanism::SparsePattern& pattern = *run.built.model.pattern;
  const int n = pattern.size(), boundary = run.built.model.sizes.boundary;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (int j = 0; j < n; ++j)
    for (int k = pattern.column_start()[j]; k < pattern.column_start()[static_cast<std::size_t>(j) + 1]; ++k) {
      const int i = pattern.rows()[k];
      A(i, j) = matrix.values[pattern.slot(i, j)];
    }
  A.topLeftCorner(boundary, boundary) *= matrix.scale;
  return A;
}

Eigen::MatrixXd iteration_matrix(Simulation& run, const mechanism::TangentCoefficients& c) {
  mechanism::evaluate(run.model(), run.state(), run.workspace.now);
  return dense_matrix(run, {c, mechanism::TangentKind::exact, {}});
}

Eigen::MatrixXd damping_matrix(Simulation& run) {
  const int n = run.model().sizes.boundary;
  return (iteration_matrix(run, {1, 1, 0}) - iteration_matrix(run, {1, 0, 0})).topLeftCorner(n, n);
}

Eigen::MatrixXd residual_difference(Simulation& run, Argument argument, double h) {
  const mechanism::State at = run.state();
  const Eigen::Index columns = argument == Argument::multiplier ? at.lambda().size() : at.v().size();
  Eigen::MatrixXd A(run.model().sizes.boundary, columns);
  const auto residual = [&](Eigen::Index j, double d) {
    mechanism::State moved = at;
    Eigen::VectorXd increment = Eigen::VectorXd::Zero(columns);
    increment[j] = d;
    if (argument == Argument::position) mechanism::retract(run.model(), at, increment, moved);
    if (argument == Argument::velocity) moved.v() += increment;
    if (argument == Argument::multiplier) moved.lambda() += increment;
    mechanism::evaluate(run.model(), moved, run.workspace.now);
    return Eigen::VectorXd(run.workspace.now.residual);
  };
  for (Eigen::Index j = 0; j < columns; ++j) A.col(j) = (residual(j, h) - residual(j, -h)) / (2.0 * h);
  return A;
}

}  // namespace tisserand::test_support

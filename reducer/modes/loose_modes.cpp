// SPDX-License-Identifier: GPL-3.0-or-later
// Change of coordinates from held pins to free ones.
#include "reducer/modes/loose_modes.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "common/error.hpp"
#include "reducer/system/mechanism.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows of the internal coordinates without the pins.
std::vector<Index> stiff_rows(Index n_I, const std::vector<int>& pins) {
  std::vector<Index> rows;
  for (int i = 0; i < n_I; ++i)
    if (!std::ranges::binary_search(pins, i)) rows.push_back(i);
  return rows;
}

/// Rows of all internal coordinates, joined from those without the pins and those of the pins.
MatrixXd whole(const InternalProblem& problem, const std::vector<int>& pins, const MatrixXd& stiff,
               const MatrixXd& at_pins) {
  MatrixXd all(problem.partition.n_I(), stiff.cols());
  all(stiff_rows(all.rows(), pins), Eigen::all) = stiff;
  all(pins, Eigen::all) = at_pins;
  return all;
}

/// Throws Error unless each motion moves mass: the mass matrix with unit diagonal is not singular to round-off.
void require_mass_of(const InternalProblem& problem, const MatrixXd& N, const MatrixXd& mass) {
  constexpr double least = 1e-10;
  const VectorXd diagonal_mass = diagonal(problem.blocks.M_II);
  const Index k = mass.rows();
  const VectorXd terms = N.cwiseAbs2().transpose() * diagonal_mass.cwiseAbs();
  for (Index i = 0; i < k; ++i)
    if (!(mass(i, i) > least * terms[i]))
      throw Error(fmt::format("a motion has neither stiffness nor mass: {}", motion_words(problem, N.col(i))),
                  problem.where, "give the nodes that move there mass (rotary inertia), or stiffness");
}

}  // namespace

Partition pinned(const Partition& p, const std::vector<int>& pins) {
  Partition result = p;
  for (const int pin : pins) {
    result.boundary.push_back(p.internal[pin]);
    result.boundary_node.push_back(-1);
    result.boundary_component.push_back(0);
  }
  result.internal.clear();
  for (const Index i : stiff_rows(p.n_I(), pins)) result.internal.push_back(p.internal[i]);
  return result;
}

void release_pins(const InternalProblem& problem, const std::vector<int>& pins, BoundaryModes& boundary,
                  InternalModes& internal) {
  const Partition& p = problem.partition;
  const Index n_B = p.n_B(), k = static_cast<Index>(pins.size()), m = internal.lambda.size();
  const MatrixXd R_B = rows(problem.system.R, p.boundary);
  const MatrixXd R_P = rows(rows(problem.system.R, p.internal), pins);
  const MatrixXd c = R_P * R_B.completeOrthogonalDecomposition().pseudoInverse();
  MatrixXd T(n_B + k, n_B);
  T << MatrixXd::Identity(n_B, n_B), c;

  const MatrixXd N = whole(problem, pins, boundary.Psi.rightCols(k), MatrixXd::Identity(k, k));
  const MatrixXd mass = symmetric_part(boundary.M.bottomRightCorner(k, k));
  require_mass_of(problem, N, mass);
  const MatrixXd shared = internal.coupling.bottomRows(k), share = mass.ldlt().solve(shared);
  const MatrixXd rest = MatrixXd::Identity(m, m) - shared.transpose() * share;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> loose(mass);
  MatrixXd Phi(p.n_I(), k + m);
  Phi.leftCols(k) = N * loose.operatorInverseSqrt();
  VectorXd lambda = VectorXd::Zero(k + m);
  if (m > 0) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> elastic(MatrixXd(internal.lambda.asDiagonal()),
                                                                     symmetric_part(rest));
    Phi.rightCols(m) = (whole(problem, pins, internal.Phi, MatrixXd::Zero(k, m)) - N * share) * elastic.eigenvectors();
    lambda.tail(m) = elastic.eigenvalues();
  }
  internal.Phi = std::move(Phi);
  internal.lambda = std::move(lambda);

  boundary.Psi = whole(problem, pins, boundary.Psi * T, c);
  boundary.S = boundary.S.topLeftCorner(n_B, n_B).eval();
  boundary.M = symmetric_part(T.transpose() * boundary.M * T);
  boundary.flexibility = boundary.flexibility.topLeftCorner(n_B, n_B).eval();
  fix_basis(problem, internal.lambda, internal.Phi);
  internal.coupling = mass_coupling(problem.blocks, boundary, internal.Phi);
  internal.left_out = {};
  internal.left_out.first_dropped = std::numeric_limits<double>::infinity();
  internal.left_out.G = MatrixXd::Zero(n_B, n_B);
  internal.pins = pins;
}

MatrixXd static_answers(const InternalProblem& problem, const InternalModes& internal, const MatrixXd& f) {
  if (internal.pins.empty()) return problem.S_II.solve(f);
  const MatrixXd N = internal.Phi.leftCols(internal.loose()), MN = multiply(problem.blocks.M_II, N);
  const MatrixXd balanced = f - MN * (N.transpose() * f);
  const std::vector<Index> stiff = stiff_rows(f.rows(), internal.pins);
  const MatrixXd x = whole(problem, internal.pins, problem.S_II.solve(balanced(stiff, Eigen::all)),
                           MatrixXd::Zero(internal.loose(), f.cols()));
  return x - N * (MN.transpose() * x);
}

}  // namespace tisserand::reducer

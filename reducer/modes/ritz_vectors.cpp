// SPDX-License-Identifier: GPL-3.0-or-later
// Rayleigh-Ritz method for the inside with the boundary held, in the space of moment vectors or of free modes.
#include "reducer/modes/ritz_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"
#include "reducer/modes/full_model.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double independent = 1e-10;  ///< least square of the new part of a vector, relative to the vector

/// Removes from W its share of the modes, in M_II. Two passes, since the first leaves round-off of what it removes.
void make_orthogonal(const Matrix& M_II, const MatrixXd& Phi, MatrixXd& W) {
  if (Phi.cols() == 0) return;
  for (int pass = 0; pass < 2; ++pass) W -= Phi * (Phi.transpose() * multiply(M_II, W));
}

/// Makes Wᵀ S W = 1 in the order of the columns (Cholesky). Columns in the span of earlier ones are dropped.
MatrixXd orthonormal_in(const Matrix& S, const MatrixXd& W) {
  const MatrixXd gram = W.transpose() * multiply(S, W);
  const Index n = gram.rows();
  MatrixXd R = MatrixXd::Zero(n, n);  // rows of the factor for the kept columns
  std::vector<Index> kept;
  for (Index k = 0; k < n; ++k) {
    const auto p = static_cast<Index>(kept.size());
    const double rest = gram(k, k) - R.col(k).head(p).squaredNorm();
    if (!(rest > independent * gram(k, k))) continue;
    R(p, k) = std::sqrt(rest);
    for (Index j = k + 1; j < n; ++j) R(p, j) = (gram(k, j) - R.col(k).head(p).dot(R.col(j).head(p))) / R(p, k);
    kept.push_back(k);
  }
  const auto p = static_cast<Index>(kept.size());
  const MatrixXd factor = R(Eigen::seqN(0, p), kept);
  MatrixXd result = W(Eigen::all, kept);
  factor.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(result);
  return result;
}

/// Columns of S_II⁻¹ X b.
MatrixXd responses(const InternalProblem& problem, const BoundaryModes& boundary, const MatrixXd& b) {
  return problem.S_II.solve(problem.blocks.M_IB * b + multiply(problem.blocks.M_II, boundary.Psi * b));
}

void fail_without_mass(const InternalProblem& problem) {
  throw Error("the mass or inertia of a rigid motion is zero, so the part has no free modes", problem.where,
              "give the part inertia about every axis, or write method: craig_bampton");
}

/// Elastic modes of the free part, by number or up to a frequency. `lambda_1`: eigenvalue of the size of the first.
FreeModes chosen_free_modes(const InternalProblem& problem, const formats::ModeSelection& selection, double lambda_1) {
  int count = selection.count;
  const Count verify = selection.cutoff ? Count::always : Count::if_cheap;
  if (selection.cutoff) {
    const SystemMatrices all = to_petsc(problem.system.matrices);
    constexpr int rigid = 6;
    count = std::max(
        0, count_below(all.stiffness, all.mass, std::pow(2.0 * std::numbers::pi * *selection.cutoff, 2)) - rigid);
  }
  if (count == 0 && !selection.cutoff) return {{VectorXd(), MatrixXd(problem.system.size(), 0)}, {}, {}};
  std::optional<FreeModes> pairs = full_free_modes(problem.system, {.scale = lambda_1, .count = std::max(1, count)},
                                                   selection, verify, problem.share);
  if (!pairs) fail_without_mass(problem);
  if (count == 0 && pairs->value.size() > 0) fail_low_cutoff(selection, "free", pairs->value[0]);
  if (pairs->value.size() < count)
    throw Error(fmt::format("{} free modes asked for, but only {} exist", count, pairs->value.size()), problem.where,
                fmt::format("ask for at most {} modes", pairs->value.size()));
  return std::move(*pairs);
}

/// Internal parts, with the boundary held, of the free modes and the six rigid accelerations: n_I x (m + 6).
MatrixXd inside_of(const InternalProblem& problem, const BoundaryModes& boundary, const MatrixXd& modes) {
  const Partition& p = problem.partition;
  const Index m = modes.cols();
  MatrixXd raw(p.n_I(), m + 6);
  raw.leftCols(m) = rows(modes, p.internal) - boundary.Psi * rows(modes, p.boundary);
  raw.rightCols<6>() = responses(problem, boundary, rows(problem.system.R, p.boundary));
  return raw;
}

/// Replaces the whole mass by MacNeal's, that of rigid motions and kept free modes alone: M Φ Φᵀ M with the lowest 6 +
/// `kept` modes Φ of the reduced part, which it holds exactly. Ritz vectors and boundary mass become canonical again.
void take_macneal_mass(const BoundaryModes& boundary, Index kept, InternalModes& modes) {
  const Index n_B = boundary.S.rows(), p = modes.lambda.size();
  MatrixXd S = MatrixXd::Zero(n_B + p, n_B + p), M = S;
  S.topLeftCorner(n_B, n_B) = boundary.S;
  S.diagonal().tail(p) = modes.lambda;
  M << boundary.M, modes.coupling, modes.coupling.transpose(), MatrixXd::Identity(p, p);
  const double shift = -0.1 * modes.lambda[0];
  const MatrixXd Q = M * dense_lowest(S, M, shift, static_cast<int>(6 + kept)).vector;
  const MatrixXd mass = Q * Q.transpose();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> inside(mass.bottomRightCorner(p, p),
                                                                  MatrixXd(modes.lambda.asDiagonal()));
  const VectorXd inverse = inside.eigenvalues().reverse();
  const Index with_mass = (inverse.array() > 1e-12 * inverse[0]).count();
  const MatrixXd Z = inside.eigenvectors().rowwise().reverse().leftCols(with_mass) *
                     inverse.head(with_mass).cwiseSqrt().cwiseInverse().asDiagonal();
  modes.lambda = inverse.head(with_mass).cwiseInverse();
  modes.Phi = (modes.Phi * Z).eval();
  modes.coupling = mass.topRightCorner(n_B, p) * Z;
  modes.boundary_mass = symmetric_part(mass.topLeftCorner(n_B, n_B));
}

}  // namespace

RitzSpace::RitzSpace(const InternalProblem& problem, const BoundaryModes& boundary, const MatrixXd& Phi, MatrixXd raw) {
  const Blocks& blocks = problem.blocks;
  make_orthogonal(blocks.M_II, Phi, raw);
  W_ = orthonormal_in(blocks.S_II, orthonormal_in(blocks.S_II, raw));
  const MatrixXd MW = multiply(blocks.M_II, W_);
  mass_ = symmetric_part(W_.transpose() * MW);
  coupling_ = mass_coupling(blocks, boundary, W_);
  if (W_.cols() == 0) return;
  MatrixXd V = problem.S_II.solve(MW);
  make_orthogonal(blocks.M_II, Phi, V);
  second_ = mass_coupling(blocks, boundary, V);
  third_ = symmetric_part(MW.transpose() * V);
}

RitzSpace::Values RitzSpace::values(Index p) const {
  if (p == 0) return {VectorXd(), MatrixXd(0, 0)};
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(mass_.topLeftCorner(p, p));
  const VectorXd mass = solver.eigenvalues().reverse();
  return {mass.cwiseInverse(),
          solver.eigenvectors().rowwise().reverse() * mass.cwiseSqrt().cwiseInverse().asDiagonal()};
}

LeftOut RitzSpace::left_out(const Values& values, const MatrixXd& G, double first_dropped) const {
  const Index p = values.Z.rows();
  const MatrixXd& Z = values.Z;
  return {first_dropped,
          G,
          values.theta,
          coupling_.leftCols(p) * Z,
          second_.leftCols(p) * Z,
          Z.transpose() * third_.topLeftCorner(p, p) * Z};
}

Index MomentSpace::whole(Index count) const {
  return count == 0 || count >= order.size() ? std::min(count, order.size())
                                             : cluster_end(order, static_cast<int>(count), 0.0);
}

MomentSpace moment_space(const InternalProblem& problem, const BoundaryModes& boundary, const MatrixXd& Phi,
                         const MatrixXd& G, double lambda) {
  const MatrixXd weight = boundary.M + boundary.S / lambda;
  const VectorXd mass = weight.diagonal();
  const VectorXd unit = (mass.array() > 0.0).select(mass.cwiseMax(1e-300).cwiseSqrt().cwiseInverse(), 0.0);
  const MatrixXd scaled_weight = unit.asDiagonal() * weight * unit.asDiagonal();
  const MatrixXd scaled_G = unit.asDiagonal() * G * unit.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(scaled_G, scaled_weight);
  const Index count = (solver.eigenvalues().array() > independent * solver.eigenvalues().maxCoeff()).count();
  const MatrixXd Y = unit.asDiagonal() * solver.eigenvectors().rowwise().reverse().leftCols(count);
  MomentSpace moments{RitzSpace(problem, boundary, Phi, responses(problem, boundary, Y)), {}};
  moments.order = solver.eigenvalues().reverse().head(moments.space.size()).cwiseInverse();
  return moments;
}

InternalModes free_boundary_vectors(const InternalProblem& problem, const BoundaryModes& boundary,
                                    const formats::ModeSelection& selection) {
  InternalModes modes;
  const Index n_I = problem.partition.n_I();
  modes.Phi.resize(n_I, 0);
  modes.coupling.resize(boundary.Psi.cols(), 0);
  modes.left_out.G = boundary.flexibility;
  modes.available = n_I > 0 ? finite_mode_count(problem.blocks.M_II) : 0;
  if (modes.available == 0) return modes;
  const Pencil pencil{problem.blocks.S_II, problem.blocks.M_II, problem.S_II, 0.0};
  const Spectrum held = lowest_pairs(pencil, 1, modes.available, choose_solver(n_I, 1, selection), Count::never);
  modes.first_dropped = held.pairs.value[0];
  const FreeModes free = chosen_free_modes(problem, selection, held.pairs.value[0]);
  const RitzSpace space(problem, boundary, modes.Phi, inside_of(problem, boundary, free.vector));
  const RitzSpace::Values values = space.values(space.size());
  modes.lambda = values.theta;
  modes.Phi = space.vectors(values);
  modes.left_out = space.left_out(values, boundary.flexibility, *modes.first_dropped);
  modes.coupling = modes.left_out.coupling;
  modes.requested = count_of(free.value);
  modes.free_modes = modes.requested;
  modes.counted = free.counted;
  modes.solver = free.solver;
  if (selection.method == formats::ReductionMethod::macneal) take_macneal_mass(boundary, free.value.size(), modes);
  const MatrixXd before = modes.Phi;
  const VectorXd lambda = modes.lambda;
  fix_basis(problem, modes.lambda, modes.Phi);
  // Φᵀ S_II Φ = Λ also if the mass is MacNeal's.
  const MatrixXd turn =
      lambda.cwiseInverse().asDiagonal() * before.transpose() * multiply(problem.blocks.S_II, modes.Phi);
  modes.coupling = (modes.coupling * turn).eval();
  return modes;
}

}  // namespace tisserand::reducer

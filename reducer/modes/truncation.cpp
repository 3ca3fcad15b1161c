// Bounds of the error by dropped modes, from reduced matrices.
#include "reducer/modes/truncation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "common/error.hpp"
#include "reducer/modes/spectrum.hpp"

namespace tisserand::reducer {
namespace {

constexpr int rigid = 6;

/// Below the spectrum, of the size of the first elastic eigenvalue; 0 if there is none. Begins with the largest
/// quotient of a coordinate; where M is nearly singular, so much of it leaves S behind in round-off, and less is tried.
double shift_of(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M) {
  double coarse = 0.0;
  for (Eigen::Index i = 0; i < S.rows(); ++i)
    if (M(i, i) > 0.0) coarse = std::max(coarse, S(i, i) / M(i, i));
  if (!(coarse > 0.0) || S.rows() <= rigid) return 0.0;
  constexpr int more_trials = 4;
  for (int trial = 0; trial < more_trials; ++trial, coarse *= 1e-3) {
    try {
      return -0.5 * dense_lowest(S, M, -coarse, rigid + 1).value[rigid];
    } catch (const Error&) {
      continue;
    }
  }
  return -0.5 * dense_lowest(S, M, -coarse, rigid + 1).value[rigid];
}

/// All modes of the reduced part that have mass, and what the boundary sees of its directions without.
struct ReducedModes {
  EigenPairs pairs;
  Eigen::MatrixXd massless;  ///< n_B x n_B: their static flexibility
};

ReducedModes reduced_modes(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, double shift, Eigen::Index n_B) {
  constexpr double least_mass = 1e-13;  // of the largest 1/(λ − shift)
  ReducedModes modes{dense_lowest(S, M, shift, static_cast<int>(S.rows())), {}};
  EigenPairs& pairs = modes.pairs;
  Eigen::Index count = 0;
  while (count < pairs.value.size() && pairs.value[count] > shift &&
         pairs.value[0] - shift > least_mass * (pairs.value[count] - shift))
    ++count;
  pairs.value.conservativeResize(count);
  pairs.vector.conservativeResize(Eigen::NoChange, count);
  const Eigen::MatrixXd u = pairs.vector.topRows(n_B);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(S.rows(), n_B);
  modes.massless = (S - shift * M).llt().solve(identity).topRows(n_B);
  modes.massless -= u * (pairs.value.array() - shift).inverse().matrix().asDiagonal() * u.transpose();
  return modes;
}

/// Number of eigenvalues below `s` of the reduced part with modes (μ, u on the boundary) when `taken` = C Cᵀ (n_B x
/// n_B) is taken off its dynamic stiffness: those of diag(μ − s) − uᵀ C Cᵀ u that are negative are as many as those of
/// diag(μ − s) and of 1 − Cᵀ u (μ − s)⁻¹ uᵀ C together (Haynsworth).
Eigen::Index count_with(const ReducedModes& modes, const Eigen::MatrixXd& taken, double s) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(taken);
  const Eigen::MatrixXd C = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  const auto& value = modes.pairs.value;
  const Eigen::MatrixXd Cu = C.transpose() * modes.pairs.vector.topRows(taken.rows());
  const Eigen::MatrixXd F =
      Cu * (value.array() - s).inverse().matrix().asDiagonal() * Cu.transpose() + C.transpose() * modes.massless * C;
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(F.rows(), F.cols()) - F;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> signs(rest, Eigen::EigenvaluesOnly);
  return (value.array() < s).count() + (signs.eigenvalues().array() < 0.0).count();
}

/// Round-off of eigenvalues: no enclosure is narrower.
constexpr double resolution = 1e-11;
constexpr int most_trials = 40;

/// What the full part's eigenvalue `k` is not below: fewer than k + 1 eigenvalues lie below it when the upper side of
/// the bound is taken off. First order in the bound and a little more, then ever more.
double lower_end(const ReducedModes& modes, const LeftOut& out, Eigen::Index k, double bound) {
  const double lambda = modes.pairs.value[k];
  double margin = 2.02 * bound + resolution;
  for (int trial = 0; trial < most_trials && margin < 1.0; ++trial, margin *= 1.5) {
    const double s = lambda * (1.0 - margin);
    if (count_with(modes, s * s / (1.0 - s / out.first_dropped) * out.residual(s), s) <= k) return s;
  }
  return 0.0;
}

/// What it is not above: as many as k + 1 lie below it when the lower side is taken off.
double upper_end(const ReducedModes& modes, const LeftOut& out, Eigen::Index k, double estimate) {
  const double lambda = modes.pairs.value[k];
  for (double margin = 1.98 * estimate; margin > resolution && margin > 0.1 * estimate; margin *= 0.8) {
    const double s = lambda * (1.0 - margin);
    if (s > 0.0 && count_with(modes, s * s * out.residual(s), s) > k) return s;
  }
  return lambda * (1.0 + resolution);
}

double estimate_of(const EigenPairs& pairs, const LeftOut& out, Eigen::Index k) {
  const Eigen::VectorXd u = pairs.vector.col(k).head(out.G.rows());
  return std::max(0.0, 0.5 * pairs.value[k] * u.dot(out.residual(pairs.value[k]) * u));
}

}  // namespace

Eigen::MatrixXd LeftOut::residual(double lambda) const {
  if (theta.size() == 0) return G;
  const Eigen::MatrixXd c = (theta.array() - lambda).inverse().matrix().asDiagonal() * coupling.transpose();
  const Eigen::MatrixXd first = coupling * c, mixed = second * c;
  Eigen::MatrixXd R = G - first - first.transpose() + c.transpose() * theta.asDiagonal() * c;
  R += lambda * (mixed + mixed.transpose() - 2.0 * c.transpose() * c) + lambda * lambda * c.transpose() * third * c;
  return R;
}

Eigen::VectorXd free_eigenvalues(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count) {
  const double shift = shift_of(S, M);
  if (shift == 0.0) return Eigen::VectorXd();
  return dense_lowest(S, M, shift, std::min(count, static_cast<int>(S.rows()))).value;
}

TruncationErrors truncation_errors(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const LeftOut& out, int most) {
  TruncationErrors errors;
  const double shift = shift_of(S, M);
  if (shift == 0.0) return errors;
  const ReducedModes modes = reduced_modes(S, M, shift, out.G.rows());
  const EigenPairs& pairs = modes.pairs;
  Eigen::Index count = 0;
  while (count < most && rigid + count < pairs.value.size() && pairs.value[rigid + count] < out.first_dropped) ++count;
  errors.lambda = pairs.value.segment(rigid, count);
  errors.estimate.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) errors.estimate[k] = estimate_of(pairs, out, rigid + k);
  errors.bound = errors.estimate.array() / (1.0 - errors.lambda.array() / out.first_dropped);
  errors.upper = errors.lambda;
  errors.lower = errors.lambda;
  if (!std::isfinite(out.first_dropped) || !(out.G.diagonal().maxCoeff() > 0.0)) return errors;
  for (Eigen::Index k = 0; k < count; ++k) {
    errors.lower[k] = lower_end(modes, out, rigid + k, errors.bound[k]);
    errors.upper[k] = upper_end(modes, out, rigid + k, errors.estimate[k]);
  }
  return errors;
}

double largest_truncation_error(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const LeftOut& out, double lambda) {
  if (!(lambda < out.first_dropped)) return std::numeric_limits<double>::infinity();
  const double shift = shift_of(S, M);
  if (shift == 0.0) return 0.0;
  const EigenPairs pairs = dense_lowest(S, M, shift, static_cast<int>(S.rows()));
  double largest = 0.0;
  for (Eigen::Index k = rigid; k < pairs.value.size() && pairs.value[k] <= lambda; ++k)
    largest = std::max(largest, estimate_of(pairs, out, k) / (1.0 - pairs.value[k] / out.first_dropped));
  return largest;
}

}  // namespace tisserand::reducer

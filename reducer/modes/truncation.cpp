// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds of the error by dropped modes, computed from reduced matrices.
#include "reducer/modes/truncation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

constexpr int rigid = 6;

/// Shift below the spectrum, of the size of the first elastic eigenvalue; 0 if there is none. Begins with the largest
/// quotient of a coordinate. If M is nearly singular, it would bury S in round-off; then smaller ones are tried.
double shift_of(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int rigid_motions) {
  double coarse = 0.0;
  for (Eigen::Index i = 0; i < S.rows(); ++i)
    if (M(i, i) > 0.0) coarse = std::max(coarse, S(i, i) / M(i, i));
  if (!(coarse > 0.0) || S.rows() <= rigid_motions) return 0.0;
  constexpr int more_trials = 4;
  for (int trial = 0; trial < more_trials; ++trial, coarse *= 1e-3) {
    try {
      return -0.5 * dense_lowest(S, M, -coarse, rigid_motions + 1).value[rigid_motions];
    } catch (const Error&) {
      continue;
    }
  }
  return -0.5 * dense_lowest(S, M, -coarse, rigid_motions + 1).value[rigid_motions];
}

/// All modes of the reduced part with mass, and the flexibility of its massless directions at the boundary.
struct ReducedModes {
  EigenPairs pairs;
  Eigen::MatrixXd massless;  ///< n_B x n_B: their static flexibility
};

ReducedModes reduced_modes(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, double shift, Eigen::Index n_B) {
  constexpr double least_mass = 1e-13;  // relative to the largest 1/(λ − shift)
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

/// Number of eigenvalues below `s` of the reduced part after `taken` = C Cᵀ (n_B x n_B) is subtracted from its dynamic
/// stiffness. The modes have (μ, u on the boundary). The number of negative eigenvalues of diag(μ − s) − uᵀ C Cᵀ u is
/// that of diag(μ − s) plus that of 1 − Cᵀ u (μ − s)⁻¹ uᵀ C (Haynsworth).
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

/// Round-off of eigenvalues, the least width of an enclosure.
constexpr double resolution = 1e-11;
/// Share above which first order may not suffice, because neighbours mix.
constexpr double first_order = 1e-6;
/// Part of the difference of both sides of the bound in estimates: as measured, true errors are nearer to the lower
/// side.
constexpr double likely = 0.25;
/// Upper side of the bound THEORY (88).
Eigen::MatrixXd upper_side(const LeftOut& out, double lambda) {
  return lambda * lambda / (1.0 - lambda / out.first_dropped) * out.residual(lambda);
}

/// Upper bound of the share of λ by which the full part's eigenvalue `k` is below that of the reduced part: at most k
/// eigenvalues are below λ (1 − share) after the upper side of the bound is subtracted. The search doubles the share
/// from `first` on until this holds.
double largest_share(const ReducedModes& modes, const LeftOut& out, Eigen::Index k, double first) {
  const double lambda = modes.pairs.value[k];
  const auto holds = [&](double share) {
    const double s = lambda * (1.0 - share);
    return s < out.first_dropped && count_with(modes, upper_side(out, s), s) <= k;
  };
  double good = first, fails = 0.0;
  while (good < 1.0 && !holds(good)) fails = std::exchange(good, 2.0 * good);
  if (good >= 1.0) return 1.0;
  while (fails > 0.0 && good > 1.1 * fails) {
    const double middle = std::sqrt(good * fails);
    (holds(middle) ? good : fails) = middle;
  }
  return good;
}

/// Share by first order in the bound, slightly increased.
double first_share(double bound) { return 2.02 * bound + resolution; }

/// Share of λ by which eigenvalue `k` is lowered by λ² R(λ) and the part `middle` (0: none, 1: all) of the difference
/// to the upper side. It lies between 0 and `largest`, with an error of 1/256 of that.
double share_with(const ReducedModes& modes, const LeftOut& out, Eigen::Index k, double middle, double largest) {
  const double lambda = modes.pairs.value[k];
  constexpr int steps = 8;
  double good = 0.0, fails = largest;
  for (int step = 0; step < steps; ++step) {
    const double share = 0.5 * (good + fails), s = lambda * (1.0 - share);
    const double ratio = s / out.first_dropped, factor = 1.0 + middle * ratio / (1.0 - ratio);
    (count_with(modes, s * s * factor * out.residual(s), s) > k ? good : fails) = share;
  }
  return good;
}

/// Relative error of a frequency whose square is too high by this share of itself; infinite for share 1.
double error_of(double share) { return 1.0 / std::sqrt(1.0 - share) - 1.0; }

/// Lower bound of the share, to first order in the estimate.
double least_share(const ReducedModes& modes, const LeftOut& out, Eigen::Index k, double estimate) {
  const double share = 1.98 * estimate, s = modes.pairs.value[k] * (1.0 - share);
  return share > resolution && count_with(modes, s * s * out.residual(s), s) > k ? share : -resolution;
}

double estimate_of(const EigenPairs& pairs, const LeftOut& out, Eigen::Index k) {
  const Eigen::VectorXd u = pairs.vector.col(k).head(out.G.rows());
  return std::max(0.0, 0.5 * pairs.value[k] * u.dot(out.residual(pairs.value[k]) * u));
}

/// W and E of attached_error(), the least for all λ up to Λ: λ/Λ times W(λ) and E(λ) are not below them.
struct Weights {
  Eigen::MatrixXd mass, strain;
};

void add_vectors(const Eigen::VectorXd& value, const Eigen::MatrixXd& coupling, double lambda, Weights& w) {
  Eigen::VectorXd mass(value.size()), strain(value.size());
  for (Eigen::Index k = 0; k < value.size(); ++k) {
    const double a = value[k], apart = std::pow(lambda - a, 2);
    // (λ_k²/(λ_k − λ)² − 1)/λ and λ_k/(λ_k − λ)² increase up to the pole at λ_k and decrease after it.
    const double at_end = (2.0 * a - lambda) * lambda / apart;
    mass[k] = lambda < a ? 2.0 * lambda / a : lambda > 2.0 * a ? at_end : std::min(2.0 * lambda / a, at_end);
    strain[k] = lambda < a ? lambda / a : std::min(lambda / a, lambda * a / apart);
  }
  w.mass += coupling * mass.asDiagonal() * coupling.transpose();
  w.strain += coupling * strain.asDiagonal() * coupling.transpose();
}

Weights weights_of(const BoundaryView& part, const LeftOut* out, double lambda) {
  Weights w{part.M, part.S / lambda};
  add_vectors(part.lambda, part.coupling, lambda, w);
  if (out != nullptr && out->theta.size() > 0) add_vectors(out->theta, out->coupling, lambda, w);
  return w;
}

/// Scale that gives `weight` a unit diagonal, and the regularised weight in these units.
struct ScaledWeight {
  Eigen::VectorXd unit;
  Eigen::MatrixXd weight;
};

ScaledWeight scaled_weight(const Eigen::MatrixXd& weight) {
  constexpr double round_off = 1e-13;
  const Eigen::VectorXd d = weight.diagonal();
  ScaledWeight s{(d.array() > 0.0).select(d.cwiseMax(1e-300).cwiseSqrt().cwiseInverse(), 0.0), {}};
  s.weight = s.unit.asDiagonal() * weight * s.unit.asDiagonal();
  s.weight.diagonal().array() += round_off;
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (s.unit[i] == 0.0) s.weight(i, i) = 1.0;
  return s;
}

/// Largest eigenvalue of the pencil (A, weight).
double largest_quotient(const Eigen::MatrixXd& A, const Eigen::MatrixXd& weight) {
  const ScaledWeight s = scaled_weight(weight);
  const Eigen::LLT<Eigen::MatrixXd> factor(s.weight);
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  Eigen::MatrixXd B = s.unit.asDiagonal() * A * s.unit.asDiagonal();
  factor.matrixL().solveInPlace(B);
  B.transposeInPlace();
  factor.matrixL().solveInPlace(B);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (B + B.transpose()), Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
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

EigenPairs free_modes(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count, int rigid_motions) {
  const double shift = shift_of(S, M, rigid_motions);
  if (shift == 0.0) return {};
  return dense_lowest(S, M, shift, std::min(count, static_cast<int>(S.rows())));
}

Eigen::VectorXd free_eigenvalues(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count, int rigid_motions) {
  return free_modes(S, M, count, rigid_motions).value;
}

TruncationErrors truncation_errors(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const LeftOut& out, int most) {
  TruncationErrors errors;
  const double shift = shift_of(S, M, rigid);
  if (shift == 0.0) return errors;
  const ReducedModes modes = reduced_modes(S, M, shift, out.G.rows());
  const EigenPairs& pairs = modes.pairs;
  Eigen::Index count = 0;
  while (count < most && rigid + count < pairs.value.size() && pairs.value[rigid + count] < out.first_dropped) ++count;
  errors.lambda = pairs.value.segment(rigid, count);
  errors.estimate.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) errors.estimate[k] = estimate_of(pairs, out, rigid + k);
  errors.bound = errors.estimate.array() / (1.0 - errors.lambda.array() / out.first_dropped);
  errors.known.assign(static_cast<std::size_t>(count), true);
  errors.upper = errors.lambda;
  errors.lower = errors.lambda;
  if (!std::isfinite(out.first_dropped) || !(out.G.diagonal().maxCoeff() > 0.0)) return errors;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double most_below = largest_share(modes, out, rigid + k, first_share(errors.bound[k]));
    const bool small = most_below < first_order;
    const double least_below = small ? least_share(modes, out, rigid + k, errors.estimate[k])
                                     : share_with(modes, out, rigid + k, 0.0, most_below);
    errors.lower[k] = errors.lambda[k] * (1.0 - most_below);
    errors.upper[k] = errors.lambda[k] * (1.0 - least_below);
    if (small) continue;
    const double most_error = error_of(most_below), least_error = error_of(least_below);
    const double likely_error = error_of(share_with(modes, out, rigid + k, likely, most_below));
    errors.estimate[k] = std::max(likely_error, 0.5 * most_error);
    errors.known[k] = likely_error >= 0.5 * most_error || most_error <= 4.0 * least_error;
  }
  return errors;
}

double attached_error(const BoundaryView& part, const LeftOut& out, double first_coupled, double lambda) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 5> parts_of_mass{0.5, 0.25, 0.75, 0.1, 0.9};
  constexpr std::array<double, 3> instants{1.0, 0.5, 0.25};  // of λ: λ R(λ) decreases below it, with rare exceptions
  constexpr Eigen::Index most_for_all = 100;
  if (!(lambda < first_coupled)) return infinite;
  if (!std::isfinite(out.first_dropped) || out.G.rows() == 0) return 0.0;  // nothing is omitted
  const Weights w = weights_of(part, &out, lambda);
  const bool small = out.G.rows() <= most_for_all;
  double least = infinite;
  for (std::size_t t = 0; t < (small ? parts_of_mass.size() : 1); ++t) {
    const Eigen::MatrixXd weight = parts_of_mass[t] * w.mass + (1.0 - parts_of_mass[t]) * w.strain;
    double largest = 0.0;
    for (std::size_t i = 0; i < (small ? instants.size() : 1); ++i) {
      const double at = instants[i] * lambda;
      largest = std::max(largest, largest_quotient(lambda / (1.0 - at / first_coupled) * out.residual(at), weight));
    }
    least = std::min(least, largest);
  }
  return least < 1.0 ? std::sqrt(1.0 + least / (1.0 - least)) - 1.0 : infinite;
}

Eigen::VectorXd boundary_shares(const BoundaryView& part, double lambda, const Eigen::MatrixXd& coupling) {
  const Weights w = weights_of(part, nullptr, lambda);
  const ScaledWeight s = scaled_weight(w.mass + w.strain);
  const Eigen::MatrixXd C = s.unit.asDiagonal() * coupling;
  const Eigen::MatrixXd solved = s.weight.llt().solve(C);
  return C.cwiseProduct(solved).colwise().sum();
}

}  // namespace tisserand::reducer

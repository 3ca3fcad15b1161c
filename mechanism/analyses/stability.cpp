// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia of the saddle matrix, and a Newton-type iteration that goes downhill where the stiffness is negative.
#include "mechanism/analyses/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/analyses/linearise.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/step/accept.hpp"

extern "C" void dsytrf_(const char* uplo, const int* n, double* A, const int* lda, int* pivots, double* work,
                        const int* lwork, int* info);

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Limit of pivots relative to the largest entry; smaller ones are zero.
constexpr double zero_pivot = 1e-13;
/// Largest asymmetry of the stiffness, relative to load/length, up to which the count decides.
constexpr double most_asymmetry = 1e-6;
/// Number of coordinates up to which all eigenvectors are computed to find a direction.
constexpr int most_resolved = 1000;

/// Factors LDLᵀ of a symmetric matrix, with its inertia.
class SymmetricFactors {
 public:
  explicit SymmetricFactors(MatrixXd A) : A_(std::move(A)), pivots_(static_cast<std::size_t>(A_.rows())) {
    const int n = static_cast<int>(A_.rows());
    const double largest = n > 0 ? A_.cwiseAbs().maxCoeff() : 0.0;
    int size = -1, info = 0;
    double best = 1.0;
    if (n == 0) return;
    dsytrf_("L", &n, A_.data(), &n, pivots_.data(), &best, &size, &info);
    size = static_cast<int>(best);
    std::vector<double> work(static_cast<std::size_t>(size));
    dsytrf_("L", &n, A_.data(), &n, pivots_.data(), work.data(), &size, &info);
    const auto count = [&](double pivot) {
      if (!(std::abs(pivot) > zero_pivot * largest))
        ++zero_;
      else if (pivot < 0.0)
        ++negative_;
    };
    for (int k = 0; k < n; ++k) {
      if (pivots_[k] > 0) {
        count(A_(k, k));
        continue;
      }
      const double a = A_(k, k), b = A_(k + 1, k), c = A_(k + 1, k + 1), mean = 0.5 * (a + c), half = 0.5 * (a - c);
      const double radius = std::sqrt(half * half + b * b);
      count(mean - radius);
      count(mean + radius);
      ++k;
    }
  }

  int negative() const { return negative_; }
  int zero() const { return zero_; }

 private:
  MatrixXd A_;
  std::vector<int> pivots_;
  int negative_ = 0, zero_ = 0;
};

double load_of(const Evaluation& evaluation, double length) {
  return std::max(evaluation.force_scale[0], evaluation.force_scale[1] / length);
}

/// The symmetric part of K and B in scaled coordinates: rotations times the characteristic length, K over its largest
/// entry.
struct Scaled {
  const Model& model;
  MatrixXd K, B;
  VectorXd scale;          ///< scale of each coordinate
  VectorXd row_scale;      ///< scale of each active constraint row
  double stiffness = 1.0;  ///< the divisor of K
  double asymmetry = 0.0;  ///< largest entry of (K − Kᵀ)/2

  /// `load` is the load of the state. Its ratio to the length replaces the stiffness if bodies have none.
  Scaled(const Model& scaled, const State& state, const Linearisation& l, double load)
      : model(scaled), scale(VectorXd::Ones(l.K.rows())) {
    scale.head(model.sizes.boundary) = model.equation_scale.head(model.sizes.boundary).matrix();
    row_scale = active_part(state, model.equation_scale.matrix().tail(model.sizes.constraints));
    K = scale.asDiagonal() * l.K * scale.asDiagonal();
    B = row_scale.asDiagonal() * l.B * scale.asDiagonal();
    stiffness = std::max(K.size() > 0 ? K.cwiseAbs().maxCoeff() : 0.0, load / model.length);
    if (!(stiffness > 0.0)) stiffness = 1.0;
    const MatrixXd odd = 0.5 / stiffness * (K - K.transpose());
    K = K / stiffness - odd;
    asymmetry = odd.size() > 0 ? odd.cwiseAbs().maxCoeff() : 0.0;
  }

  MatrixXd saddle() const {
    const Eigen::Index n = K.rows(), m = B.rows();
    MatrixXd A = MatrixXd::Zero(n + m, n + m);
    A.topLeftCorner(n, n) = K;
    A.bottomLeftCorner(m, n) = B;
    A.topRightCorner(n, m) = B.transpose();
    return A;
  }
  /// Size of scaled ξ: the largest translation over the characteristic length, or rotation.
  double size_of_move(const VectorXd& xi) const {
    const Eigen::Index n = model.sizes.boundary;
    return n > 0 ? xi.head(n).cwiseAbs().maxCoeff() / model.length : 0.0;
  }
};

/// Eigenvector of the least eigenvalue of ZᵀKZ, in coordinates of a linearisation. If the eigenvalue is multiple, the
/// result moves the coordinate most that its eigenvectors move most, because their own basis is arbitrary.
VectorXd lowest_direction(const Linearisation& l, const Scaled& s) {
  constexpr double equal = 1e-6, as_large = 0.9;
  const MatrixXd Z = s.scale.cwiseInverse().asDiagonal() * null_space(s.model, l.B);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(Z.transpose() * s.K * Z);
  const VectorXd& lambda = eigen.eigenvalues();
  const double close = equal * std::abs(lambda[0]) + zero_pivot * lambda.cwiseAbs().maxCoeff();
  const auto count = (lambda.array() <= lambda[0] + close).count();
  const MatrixXd V = Z * eigen.eigenvectors().leftCols(count);
  const VectorXd size = V.rowwise().norm();
  Eigen::Index most = 0;
  while (size[most] < as_large * size.maxCoeff()) ++most;
  return s.scale.asDiagonal() * (V * V.row(most).transpose());
}

Stability count(const Scaled& s, const Evaluation& evaluation) {
  Stability result;
  const SymmetricFactors factors(s.saddle());
  result.counted = true;
  result.unstable = std::max(0, factors.negative() - static_cast<int>(s.B.rows()));
  result.neutral = factors.zero();
  const double load = load_of(evaluation, s.model.length) / s.model.length;
  result.symmetric = s.asymmetry * s.stiffness <= most_asymmetry * load + zero_pivot * s.stiffness;
  return result;
}

constexpr double farthest_move = 0.1;  ///< relative to the characteristic length, or in radians
constexpr double first_push = 0.01;    ///< displacement out of an unstable equilibrium
constexpr double zero_stiffness =
    32.0 * std::numeric_limits<double>::epsilon();  ///< round-off of eigenvalues, relative to the largest
constexpr double least_damping = 1e-13;             ///< relative to the largest stiffness
constexpr int most_descents = 500;                  ///< in each of the two ways to search

/// Constraints at a state and the eigenpairs (lambda, V) of ZᵀKZ; [Y Z] is orthogonal, Y spans the rows.
struct StiffnessSpectrum {
  Eigen::HouseholderQR<MatrixXd> rows;
  MatrixXd Y, R, V;  ///< Bᵀ = Y R
  VectorXd lambda;

  explicit StiffnessSpectrum(const Scaled& s) : rows(s.B.transpose()) {
    const Eigen::Index n = s.K.rows(), m = s.B.rows();
    const MatrixXd Q = rows.householderQ() * MatrixXd::Identity(n, n);
    Y = Q.leftCols(m);
    R = rows.matrixQR().topRows(m);
    const MatrixXd Z = Q.rightCols(n - m);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(Z.transpose() * s.K * Z);
    lambda = eigen.eigenvalues();
    V = Z * eigen.eigenvectors();
  }
  bool has_negative() const { return lambda.size() > 0 && lambda[0] < -zero_stiffness; }
  bool has_neutral() const { return lambda.size() > 0 && lambda.cwiseAbs().minCoeff() <= zero_stiffness; }
};

/// Step ξ with multipliers (scaled). It closes the constraints and moves along each eigenvector v by −v·r/(|λ| + μ). μ
/// is the least value from `damping` on that keeps the step short. Where the stiffness is positive this is Newton's
/// step, where it is negative it goes downhill.
struct DownhillStep {
  VectorXd xi, multipliers;
  double damping, decrease;  ///< μ, and Σ (v·r)²/(|λ| + μ)

  DownhillStep(const Scaled& s, const StiffnessSpectrum& spectrum, const VectorXd& r, const VectorXd& open,
               double least)
      : damping(least) {
    const VectorXd closing = -(spectrum.Y * spectrum.R.transpose().triangularView<Eigen::Lower>().solve(open));
    const VectorXd force = spectrum.V.transpose() * (r + s.K * closing);
    for (;; damping *= 4.0) {
      const VectorXd q = force.cwiseQuotient((spectrum.lambda.cwiseAbs().array() + damping).matrix());
      xi = closing - spectrum.V * q;
      decrease = force.dot(q);
      if (damping > most_damping || !(s.size_of_move(xi) > farthest_move)) break;
    }
    multipliers = spectrum.R.triangularView<Eigen::Upper>().solve(VectorXd(-(spectrum.Y.transpose() * (r + s.K * xi))));
  }

  static constexpr double most_damping = 1e6;
};

/// Work r·ξ of the last evaluate(), with rotations of ξ in world axes.
double work_along(const Model& model, const Evaluation& evaluation, const VectorXd& xi) {
  VectorXd r(xi.size());
  gather_residual(model, evaluation, r);
  return r.dot(material_increment(model, evaluation, xi));
}

/// Displacement `first_push` downhill along the eigenvector of the most negative eigenvalue.
VectorXd push(const Scaled& s, const StiffnessSpectrum& spectrum, const VectorXd& r) {
  VectorXd xi = s.scale.cwiseProduct(spectrum.V.col(0));
  xi *= first_push / s.size_of_move(spectrum.V.col(0));
  Eigen::Index most = 0;
  xi.cwiseAbs().maxCoeff(&most);
  const double work = r.dot(xi.cwiseQuotient(s.scale));
  if (work > 0.0 || (work == 0.0 && xi[most] < 0.0)) xi = -xi;
  return xi;
}

struct Descent {
  const Model& model;
  const Balanced &balanced, &interrupted;
  State& state;
  Evaluation& evaluation;

  DescentReport go(bool cautious) const;
};

/// Steps take Newton's corrections in stiff directions, even if they overshoot, because they follow curved valleys
/// fast. If `cautious`, a step is shortened where the forces along it change sign.
DescentReport Descent::go(bool cautious) const {
  DescentReport report;
  VectorXd moved;
  double damping = least_damping;
  for (; report.iterations < most_descents; ++report.iterations) {
    if (interrupted && interrupted()) return report;
    const Linearisation l = linearise_stiffness(model, state, evaluation);
    if (!l.r.allFinite()) return report;
    const bool done = balanced();
    settle(model, evaluation, state);
    const Scaled s(model, state, l, load_of(evaluation, model.length));
    const StiffnessSpectrum spectrum(s);
    if (done && !spectrum.has_negative()) {
      report.found = !spectrum.has_neutral();
      if (report.found) return report;
      Eigen::Index least = 0;
      spectrum.lambda.cwiseAbs().minCoeff(&least);
      report.direction = name_of_direction(model, state, s.scale.cwiseProduct(spectrum.V.col(least)), evaluation);
      return report;
    }
    const VectorXd r = s.scale.cwiseProduct(l.r) / s.stiffness, none = VectorXd::Zero(l.B.rows());
    if (done) {
      moved = push(s, spectrum, r);
      move_by(model, moved, none, evaluation, state);
      continue;
    }
    const State before = state;
    const VectorXd open = s.row_scale.cwiseProduct(active_part(state, evaluation.constraint));
    for (;;) {
      const DownhillStep step(s, spectrum, r, open, damping);
      if (!step.xi.allFinite()) return report;
      moved = s.scale.cwiseProduct(step.xi);
      move_by(model, moved, s.stiffness * s.row_scale.cwiseProduct(step.multipliers), evaluation, state);
      if (!cautious) break;
      evaluate(model, state, evaluation);
      damping = step.damping;
      if (!(work_along(model, evaluation, moved) > 0.5 * s.stiffness * step.decrease)) break;
      if (damping > DownhillStep::most_damping) return report;
      state.block() = before.block();
      evaluate(model, state, evaluation);
      damping *= 10.0;
    }
    damping = std::max(least_damping, 0.1 * damping);
  }
  evaluate(model, state, evaluation);
  report.direction = name_of_direction(model, state, moved, evaluation);
  return report;
}

}  // namespace

Stability stability_of(const Model& model, const State& state, Evaluation& evaluation, bool name) {
  if (model.sizes.velocities() > most_linearised) return {};
  const Linearisation l = linearise_stiffness(model, state, evaluation);
  const Scaled s(model, state, l, load_of(evaluation, model.length));
  Stability result = count(s, evaluation);
  if (name && result.unstable + result.neutral > 0 && l.K.rows() <= most_resolved)
    result.direction = name_of_direction(model, state, lowest_direction(l, s), evaluation);
  return result;
}

DescentReport descend(const Model& model, const Balanced& balanced, const Balanced& interrupted, State& state,
                      Evaluation& evaluation) {
  if (model.sizes.velocities() > most_resolved) return {};
  const State begin = state;
  DescentReport report;
  int iterations = 0;
  const Descent descent{model, balanced, interrupted, state, evaluation};
  for (const bool cautious : {false, true}) {
    state.block() = begin.block();
    report = descent.go(cautious);
    iterations += report.iterations;
    if (report.found || (interrupted && interrupted())) break;
  }
  report.iterations = iterations;
  return report;
}

}  // namespace tisserand::mechanism

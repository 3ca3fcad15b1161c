// SPDX-License-Identifier: GPL-3.0-or-later
// Dense Craig-Bampton with the residual flexibility of the dropped modes, beside the modes of the full model.
#include "tests/reducer/synthesis_estimates.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "reducer/system/partition.hpp"
#include "tests/reducer/parts.hpp"

namespace tisserand::testing {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Modes {
  VectorXd lambda;  ///< ascending
  MatrixXd X;       ///< of unit modal mass
};

/// S x = λ M x from (S - shift M)⁻¹, accurate at the low end.
Modes modes_of(const MatrixXd& S, const MatrixXd& M, double shift) {
  const MatrixXd shifted = S - shift * M;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(M, shifted);
  Modes modes{solver.eigenvalues().reverse().cwiseInverse().array() + shift, solver.eigenvectors().rowwise().reverse()};
  for (Index k = 0; k < modes.X.cols(); ++k) modes.X.col(k) /= std::sqrt(modes.X.col(k).dot(M * modes.X.col(k)));
  return modes;
}

/// Coordinates in the order [internal; boundary].
struct CraigBampton {
  MatrixXd S, M;         ///< of the full model
  MatrixXd T;            ///< [Φ Ψ; 0 1]
  MatrixXd FA;           ///< F A
  double first_dropped;  ///< λ_c
};

CraigBampton craig_bampton(const FullModel& full, int count) {
  const reducer::Partition p = reducer::partition(full.mesh, full.system);
  std::vector<int> order = p.internal;
  order.insert(order.end(), p.boundary.begin(), p.boundary.end());
  const Index n_I = p.n_I(), n_B = p.n_B();
  CraigBampton cb{full.S(order, order), full.M(order, order), MatrixXd::Zero(n_I + n_B, count + n_B), {}, 0.0};
  const MatrixXd S_II = cb.S.topLeftCorner(n_I, n_I), M_II = cb.M.topLeftCorner(n_I, n_I);
  const Eigen::LLT<MatrixXd> factor(S_II);
  const MatrixXd Psi = -factor.solve(MatrixXd(cb.S.topRightCorner(n_I, n_B)));
  const Modes held = modes_of(S_II, M_II, 0.0);
  const MatrixXd Phi = held.X.leftCols(count);
  cb.T << Phi, Psi, MatrixXd::Zero(n_B, count), MatrixXd::Identity(n_B, n_B);
  const MatrixXd A = cb.M.topRightCorner(n_I, n_B) + M_II * Psi;
  cb.FA = factor.solve(A) - Phi * held.lambda.head(count).cwiseInverse().asDiagonal() * Phi.transpose() * A;
  cb.first_dropped = count < n_I ? held.lambda[count] : std::numeric_limits<double>::infinity();
  return cb;
}

double estimate(const CraigBampton& cb, const VectorXd& phi, double lambda) {
  const VectorXd x = cb.T * phi;
  VectorXd x_a = VectorXd::Zero(x.size());
  x_a.head(cb.FA.rows()) = lambda * (cb.FA * phi.tail(cb.FA.cols()));
  const VectorXd D_xa = cb.S * x_a / lambda - cb.M * x_a;
  return -2.0 * x.dot(D_xa) - x_a.dot(D_xa);
}

}  // namespace

ModeQuality mode_quality(const formats::Part& part, double shift) {
  const reducer::Reduction r = reduce(part);
  const CraigBampton cb = craig_bampton(full_model(part), r.model.modes_kept);
  const Modes full = modes_of(cb.S, cb.M, shift);
  const Modes reduced = modes_of(cb.T.transpose() * cb.S * cb.T, cb.T.transpose() * cb.M * cb.T, shift);
  const VectorXd lambda_file = eigenvalues(r.superelement.stiffness, r.superelement.mass, shift);
  const Index n = reduced.lambda.size() - 6;
  ModeQuality q;
  for (VectorXd* v : {&q.frequency, &q.error, &q.estimate, &q.bound, &q.mac, &q.cross_orthogonality}) v->resize(n);
  for (Index k = 0; k < n; ++k) {
    const double lambda = full.lambda[k + 6], lambda_reduced = reduced.lambda[k + 6];
    const VectorXd x = cb.T * reduced.X.col(k + 6), y = full.X.col(k + 6);
    q.frequency[k] = std::sqrt(lambda) / (2.0 * std::numbers::pi);
    q.error[k] = lambda_reduced / lambda - 1.0;
    q.estimate[k] = estimate(cb, reduced.X.col(k + 6), lambda_reduced);
    q.bound[k] =
        lambda < cb.first_dropped ? lambda / (cb.first_dropped - lambda) : std::numeric_limits<double>::infinity();
    q.mac[k] = std::pow(x.dot(y), 2) / (x.squaredNorm() * y.squaredNorm());
    q.cross_orthogonality[k] = std::abs(x.dot(cb.M * y));
    q.solver_difference = std::max(q.solver_difference, std::abs(lambda_file[k + 6] / lambda_reduced - 1.0));
  }
  return q;
}

}  // namespace tisserand::testing

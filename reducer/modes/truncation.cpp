// Bounds of the error by dropped modes, from reduced matrices.
#include "reducer/modes/truncation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "common/error.hpp"

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

/// Reduced matrices with internal coordinates at `lambda` that carry the dropped mass C √λ.
struct Augmented {
  Eigen::MatrixXd S, M;
};

Augmented augment(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const Eigen::MatrixXd& G, double lambda) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(G);
  const Eigen::VectorXd& value = solver.eigenvalues();
  const Eigen::Index rank = (value.array() > 1e-14 * value.maxCoeff()).count(), n = S.rows();
  Augmented a{Eigen::MatrixXd::Zero(n + rank, n + rank), Eigen::MatrixXd::Zero(n + rank, n + rank)};
  a.S.topLeftCorner(n, n) = S;
  a.M.topLeftCorner(n, n) = M;
  a.S.diagonal().tail(rank).setConstant(lambda);
  a.M.diagonal().tail(rank).setOnes();
  const Eigen::MatrixXd C = solver.eigenvectors().rightCols(rank) * value.tail(rank).cwiseSqrt().asDiagonal();
  a.M.block(0, n, G.rows(), rank) = std::sqrt(lambda) * C;
  a.M.block(n, 0, rank, G.rows()) = std::sqrt(lambda) * C.transpose();
  return a;
}

Eigen::MatrixXd with_mass(const Eigen::MatrixXd& M, double factor, const Eigen::MatrixXd& G) {
  Eigen::MatrixXd sum = M;
  sum.topLeftCorner(G.rows(), G.rows()) += factor * G;
  return sum;
}

}  // namespace

EigenPairs free_modes(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count) {
  const double shift = shift_of(S, M);
  if (shift == 0.0) return {};
  return dense_lowest(S, M, shift, std::min(count, static_cast<int>(S.rows())));
}

Eigen::VectorXd free_eigenvalues(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count) {
  return free_modes(S, M, count).value;
}

TruncationErrors truncation_errors(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const Eigen::MatrixXd& G,
                                   double first_dropped, int most) {
  constexpr Eigen::Index small = 200;
  TruncationErrors errors;
  const double shift = shift_of(S, M);
  if (shift == 0.0) return errors;
  const EigenPairs pairs = dense_lowest(S, M, shift, std::min(rigid + most, static_cast<int>(S.rows())));
  Eigen::Index count = 0;
  while (rigid + count < pairs.value.size() && pairs.value[rigid + count] < first_dropped) ++count;
  errors.lambda = pairs.value.segment(rigid, count);
  const Eigen::MatrixXd u = pairs.vector.block(0, rigid, G.rows(), count);
  errors.estimate = 0.5 * errors.lambda.cwiseProduct((u.transpose() * G * u).diagonal()).cwiseMax(0.0);
  errors.bound = errors.estimate.array() / (1.0 - errors.lambda.array() / first_dropped);
  errors.upper = errors.lambda;
  errors.lower = errors.lambda;
  if (count == 0 || !std::isfinite(first_dropped) || !(G.diagonal().maxCoeff() > 0.0)) return errors;
  const Augmented a = augment(S, M, G, first_dropped);
  errors.lower = dense_lowest(a.S, a.M, shift, static_cast<int>(rigid + count)).value.tail(count);
  if (S.rows() > small) return errors;
  for (Eigen::Index k = 0; k < count; ++k)
    errors.upper[k] =
        dense_lowest(S, with_mass(M, errors.lower[k], G), shift, static_cast<int>(rigid + k + 1)).value[rigid + k];
  return errors;
}

double largest_truncation_error(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const Eigen::MatrixXd& G,
                                double first_dropped, double lambda) {
  if (!(lambda < first_dropped)) return std::numeric_limits<double>::infinity();
  const double shift = shift_of(S, M);
  if (shift == 0.0) return 0.0;
  const EigenPairs pairs = dense_lowest(S, M, shift, static_cast<int>(S.rows()));
  double largest = 0.0;
  for (Eigen::Index k = rigid; k < pairs.value.size() && pairs.value[k] <= lambda; ++k) {
    const Eigen::VectorXd u = pairs.vector.col(k).head(G.rows());
    largest = std::max(largest, 0.5 * pairs.value[k] * u.dot(G * u) / (1.0 - pairs.value[k] / first_dropped));
  }
  return largest;
}

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Load factors: bracketed and counted by inertia, found by shift-invert Krylov-Schur iteration below the lowest.
#include "reducer/modes/load_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "reducer/modes/spectrum.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double most_apart = 1e3;         ///< multiple of the lowest; stress hardly affects motions near μ = 0
constexpr double largest_residual = 1e-6;  ///< the error of λ is its square

/// The load (sign 1) or the reversed load (−1): (S + sign λ K_g) φ = 0.
struct Side {
  const StressPencil& pencil;
  double sign = 1.0;
  double limit = 0.0;  ///< LoadFactors::limit
  int exist = 0;       ///< factors up to the limit
  double below = 0.0;  ///< λ below the lowest factor, and near it if it exists

  Matrix sum(double lambda) const { return combine(pencil.S, sign * lambda, pencil.K_g); }
  /// Number of factors below `lambda`: negative eigenvalues of the sum, by Sylvester's law of inertia.
  int count(double lambda) const { return Factor::indefinite(sum(lambda)).negative(); }
};

/// Lower estimate of the largest |μ| of K_g φ = μ S φ, to some per cent; 0 without stress. Power iteration with S⁻¹ K_g
/// on a few vectors: their growth in the norm of S is the same for both signs of μ.
double largest_stress(const StressPencil& pencil) {
  constexpr int most_steps = 30;
  constexpr double enough = 0.02;
  const Index n = pencil.S.size();
  MatrixXd X = MatrixXd::NullaryExpr(n, std::min<Index>(n, 4), [](Index i, Index k) {
    return std::sin(static_cast<double>(i + 1) * (1.3 + static_cast<double>(k)));
  });
  X = pencil.factor.solve(X);  // random forces give displacements of similar energy
  double largest = 0.0;
  for (int step = 0; step < most_steps; ++step) {
    const VectorXd before = X.cwiseProduct(multiply(pencil.S, X)).colwise().sum();
    const MatrixXd force = multiply(pencil.K_g, X);
    X = pencil.factor.solve(force);
    const VectorXd after = X.cwiseProduct(force).colwise().sum();
    if (!(after.maxCoeff() > 0.0)) return largest;
    const double growth = std::sqrt((after.array() / before.array()).maxCoeff());
    X = (X * after.cwiseSqrt().cwiseInverse().asDiagonal()).eval();
    const bool settled = growth < (1.0 + enough) * largest;
    largest = std::max(largest, growth);
    if (settled) break;
  }
  return largest;
}

/// Counts the factors of one side up to the limit and brackets the lowest. `lowest` is 1/|μ| of largest_stress(); no
/// factor of either side is far below it.
Side find_side(const StressPencil& pencil, double sign, double lowest) {
  constexpr double near = 3.0;
  Side side{pencil, sign, most_apart * lowest, 0, 0.7 * lowest};
  side.exist = side.count(side.limit);
  if (side.exist == 0) return side;
  while (side.count(side.below) > 0) side.below *= 0.7;
  double above = 2.0 * lowest;
  if (side.count(above) == 0) {
    side.below = above;
    above = side.limit;
  }
  while (above > near * side.below) {
    const double middle = std::sqrt(side.below * above);
    (side.count(middle) > 0 ? above : side.below) = middle;
  }
  return side;
}

/// Merges pairs of K_g φ = μ S φ into λ ascending and φ: λ = −1/(sign μ).
void merge(const EigenPairs& more, const Side& side, EigenPairs& pairs) {
  std::vector<std::pair<double, VectorXd>> all;
  for (Index k = 0; k < pairs.value.size(); ++k) all.emplace_back(pairs.value[k], pairs.vector.col(k));
  for (Index k = 0; k < more.value.size(); ++k)
    if (const double reciprocal = -side.sign * more.value[k]; reciprocal * side.limit > 1.0)
      all.emplace_back(1.0 / reciprocal, more.vector.col(k));
  std::ranges::sort(all, {}, &std::pair<double, VectorXd>::first);
  pairs.value.resize(static_cast<Index>(all.size()));
  pairs.vector.resize(more.vector.rows(), pairs.value.size());
  for (Index k = 0; k < pairs.value.size(); ++k) {
    pairs.value[k] = all[k].first;
    pairs.vector.col(k) = all[k].second;
  }
}

/// First and end of the group of equal factors that contains number `k`.
struct Group {
  int first = 0, end = 0;
};
Group group_of(const VectorXd& lambda, int k) {
  const auto equal = [&](int a, int b) { return std::abs(lambda[a] - lambda[b]) <= cluster_tolerance * lambda[a]; };
  Group group{k, k + 1};
  while (group.first > 0 && equal(group.first, group.first - 1)) --group.first;
  while (group.end < lambda.size() && equal(group.end - 1, group.end)) ++group.end;
  return group;
}

/// λ between the factors `k` − 1 and `k`, or just outside the ends.
double between(const Side& side, const VectorXd& lambda, int k) {
  if (k == 0) return side.below;
  return k < lambda.size() ? std::sqrt(lambda[k - 1] * lambda[k]) : lambda[k - 1] * (1.0 + 10.0 * cluster_tolerance);
}

/// The `count` lowest existing factors, with equal ones after them if these are few, and the number of further ones
/// that equal the last.
std::pair<EigenPairs, int> lowest_factors(const Side& side, int count) {
  constexpr int attempts = 8, many_equal = 8;
  const StressPencil& pencil = side.pencil;
  const double shift = side.sign * side.below;
  const Factor factor(side.sum(side.below));
  const int asked = std::min(side.exist, count), wanted = std::min(side.exist, count + 2);
  EigenPairs pairs{VectorXd(0), MatrixXd(pencil.S.size(), 0)};
  for (int attempt = 0, missing = wanted; attempt < attempts; ++attempt) {
    // K_g − μ S = (S + shift K_g)/shift at μ = −1/shift.
    Eps eps(pencil.K_g, pencil.S, {-1.0 / shift, [&](const MatrixXd& X) { return MatrixXd(shift * factor.solve(X)); }});
    eps.solve(EigenSolver::krylov_schur, missing, pairs.vector);  // one Krylov sequence misses equal ones
    merge(eps.pairs(std::numeric_limits<int>::max()), side, pairs);
    pencil.share(0.3 + 0.5 * (attempt + 1) / attempts);
    const auto found = count_of(pairs.value);
    missing = wanted - std::min(found, wanted - 1);
    if (found < asked) continue;
    const Group last = group_of(pairs.value, asked - 1);
    const int counted = last.end == side.exist ? side.exist : side.count(between(side, pairs.value, last.end));
    if (counted == last.end) return {{pairs.value.head(last.end), pairs.vector.leftCols(last.end)}, 0};
    missing = std::max(1, counted - last.end);
    if (missing <= many_equal) continue;
    if (side.count(between(side, pairs.value, last.first)) == last.first)
      return {{pairs.value.head(asked), pairs.vector.leftCols(asked)}, counted - asked};
    missing = wanted;
  }
  throw Error(
      fmt::format("{} load factors of buckling were found, but others below them were missed", pairs.value.size()),
      "eigenvalue solver", "ask for fewer or more of them, or report this with the part file");
}

/// Normalises φᵀ S φ = 1 and computes factors as Rayleigh's quotients, and the residual.
void finish(const StressPencil& pencil, const EigenPairs& pairs, LoadFactors& result) {
  const Index kept = pairs.value.size();
  result.shape = pairs.vector;
  result.factor.resize(kept);
  const MatrixXd S_shape = multiply(pencil.S, result.shape), G_shape = multiply(pencil.K_g, result.shape);
  const MatrixXd next = pencil.factor.solve(G_shape);  // S⁻¹ K_g φ
  for (Index k = 0; k < kept; ++k) {
    const double size = result.shape.col(k).dot(S_shape.col(k));
    const double lambda = -size / result.shape.col(k).dot(G_shape.col(k));
    const VectorXd rest = result.shape.col(k) + lambda * next.col(k);
    const VectorXd S_rest = S_shape.col(k) + lambda * G_shape.col(k);
    result.factor[k] = lambda;
    result.residual = std::max(result.residual, std::sqrt(std::max(0.0, rest.dot(S_rest)) / size));
    result.shape.col(k) /= std::sqrt(size);
  }
  if (!(result.residual <= largest_residual))
    throw Error(
        fmt::format("load factors of buckling have a relative residual of {:.1e}, but at most {:.0e} is accepted",
                    result.residual, largest_residual),
        "eigenvalue solver",
        "the part is ill-conditioned: avoid very short elements next to very long ones, and very stiff elements next "
        "to very soft ones");
}

}  // namespace

LoadFactors load_factors(const StressPencil& pencil, int count) {
  LoadFactors result;
  result.shape.resize(pencil.S.size(), 0);
  const double stress = largest_stress(pencil);
  if (!(stress > 0.0)) return result;
  pencil.share(0.2);
  const Side side = find_side(pencil, 1.0, 1.0 / stress);
  result.limit = side.limit;
  pencil.share(0.3);
  if (side.exist > 0) {
    auto [pairs, more_equal] = lowest_factors(side, count);
    result.more_equal = more_equal;
    finish(pencil, pairs, result);
  }
  pencil.share(0.8);
  const Side other = find_side(pencil, -1.0, 1.0 / stress);
  if (other.exist > 0) result.reversed = lowest_factors(other, 1).first.value[0];
  return result;
}

}  // namespace tisserand::reducer

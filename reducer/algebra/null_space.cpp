// SPDX-License-Identifier: GPL-3.0-or-later
// Subspace iteration for the lowest eigenvectors of S in the inner product of its diagonal.
#include "reducer/algebra/null_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double suspicious_share = 1e-12;  ///< energies below this are examined more closely

/// Numbers between -1/2 and 1/2 that are the same in every run (a linear congruential generator modulo 2⁶⁴).
MatrixXd scattered(Index rows, Index columns) {
  MatrixXd B(rows, columns);
  std::uint64_t state = 1;
  for (Index c = 0; c < columns; ++c)
    for (Index i = 0; i < rows; ++i) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      B(i, c) = std::ldexp(static_cast<double>(state >> 11U), -53) - 0.5;
    }
  return B;
}

/// Square roots of diag(S); a coordinate without stiffness gets that of the largest entry.
VectorXd scale_of(const Matrix& S) {
  const VectorXd d = diagonal(S);
  const double largest = d.cwiseAbs().maxCoeff();
  return (d.array() > 0.0).select(d, largest > 0.0 ? largest : 1.0).cwiseSqrt();
}

/// Gram-Schmidt orthogonalisation in three passes, since columns may be parallel except for round-off.
MatrixXd orthonormal(MatrixXd Q) {
  constexpr int passes = 3;
  for (Index c = 0; c < Q.cols(); ++c)
    for (int pass = 0; pass < passes; ++pass) {
      Q.col(c).normalize();
      Q.col(c) -= Q.leftCols(c) * (Q.leftCols(c).transpose() * Q.col(c)).eval();
      Q.col(c).normalize();
    }
  return Q;
}

/// Ritz vectors of S in the space of X, softest first.
MatrixXd softest_first(const Matrix& S, const VectorXd& scale, const MatrixXd& X) {
  const MatrixXd Q = orthonormal(scale.asDiagonal() * X);
  const MatrixXd V = scale.cwiseInverse().asDiagonal() * Q;
  const MatrixXd energy = V.transpose() * multiply(S, V);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(0.5 * (energy + energy.transpose()));
  return V * solver.eigenvectors();
}

/// vᵀ S v / |v|ᵀ |S| |v|. A coordinate without stiffness counts with its scale among the terms.
double energy_share(const Matrix& S, const VectorXd& scale, const VectorXd& v) {
  const SymmetricRows A = symmetric_rows(S);
  double sum = 0.0, terms = 0.0;
  for (int i = 0; i < A.size; ++i) {
    if (!(A.value[A.begin[i]] > 0.0)) terms += scale[i] * scale[i] * v[i] * v[i];
    for (int k = A.begin[i]; k < A.begin[i + 1]; ++k) {
      const double term = (A.column[k] == i ? 1.0 : 2.0) * A.value[k] * v[i] * v[A.column[k]];
      sum += term;
      terms += std::abs(term);
    }
  }
  return terms > 0.0 ? sum / terms : 0.0;
}

/// Counts the leading null columns of V and notes the first column that is not null.
Index count_null(const Matrix& S, const VectorXd& scale, const MatrixXd& V, NullSpace& result) {
  for (Index k = 0; k < V.cols(); ++k) {
    const double share = energy_share(S, scale, V.col(k));
    if (share <= null_share) continue;
    result.least_share = share;
    result.softest = V.col(k);
    return k;
  }
  return V.cols();
}

/// Factor of S + 1e-12 diag(S); scale² replaces the entries that are missing in the diagonal.
Factor shifted_factor(const Matrix& S, const VectorXd& scale) {
  constexpr double shift = 1e-12;
  const SymmetricRows A = symmetric_rows(S);
  SymmetricPair pair{{A.begin, A.begin + A.size + 1},
                     {A.column, A.column + A.begin[A.size]},
                     {A.value, A.value + A.begin[A.size]},
                     {}};
  pair.M.assign(pair.S.size(), 0.0);
  for (int i = 0; i < A.size; ++i) pair.S[pair.begin[i]] += shift * scale[i] * scale[i];
  return Factor(to_petsc(pair).stiffness);
}

/// Sets the basis that is the unit matrix at `pivots`, the coordinates that pivoting chooses.
void set_basis(const VectorXd& scale, const MatrixXd& V, NullSpace& result) {
  const Index k = V.cols();
  const MatrixXd scaled = V.transpose() * scale.asDiagonal();
  const Eigen::ColPivHouseholderQR<MatrixXd> pivoting(scaled);
  for (Index i = 0; i < k; ++i) result.pivots.push_back(pivoting.colsPermutation().indices()[i]);
  std::ranges::sort(result.pivots);
  const MatrixXd at_pivots = V(result.pivots, Eigen::all);
  result.vectors = at_pivots.transpose().partialPivLu().solve(V.transpose()).transpose();
}

}  // namespace

NullSpace searched_null_space(const Matrix& S, const Factor& factor) {
  constexpr Index block = 8;
  constexpr int iterations = 3;
  NullSpace result;
  const Index n = S.size();
  if (n == 0) return result;
  const VectorXd scale = scale_of(S);
  if (factor.null() == 0 && factor.negative() == 0) {
    const MatrixXd B = scale.asDiagonal() * scattered(n, std::min(block, n));
    const MatrixXd V = softest_first(S, scale, factor.solve(B));
    result.least_share = energy_share(S, scale, V.col(0));
    result.softest = V.col(0);
    if (result.least_share > suspicious_share) return result;
  }
  const Factor shifted = shifted_factor(S, scale);
  if (shifted.negative() > 0 || shifted.null() > 0) {
    result.negative = std::max(1, shifted.negative());
    return result;
  }
  for (Index columns = std::min(block, n);; columns = std::min(4 * columns, n)) {
    MatrixXd V = scale.cwiseInverse().asDiagonal() * scattered(n, columns);
    for (int pass = 0; pass < iterations; ++pass)
      V = softest_first(S, scale, shifted.solve(scale.cwiseAbs2().asDiagonal() * V));
    const Index null = count_null(S, scale, V, result);
    if (null == columns && columns < n) continue;
    if (null > 0) set_basis(scale, V.leftCols(null), result);
    return result;
  }
}

NullSpace null_space(const Matrix& S, const Factor& factor) {
  if (factor.least_pivot() > trusted_pivot) return {};
  return searched_null_space(S, factor);
}

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Null space of a sparse symmetric stiffness matrix, checked before anything divides by its factor.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/algebra/factor.hpp"
#include "reducer/algebra/symmetric_pair.hpp"

namespace tisserand::reducer {

/// Motions v without stiffness. Their strain energy vᵀ S v is only round-off of its terms: at most `null_share` of |v|ᵀ
/// |S| |v|.
struct NullSpace {
  Eigen::MatrixXd vectors;   ///< n x k: a basis that is the unit matrix at `pivots`
  std::vector<int> pivots;   ///< the k coordinates of the unit matrix
  int negative = 0;          ///< negative eigenvalues of S, if it is indefinite beyond round-off
  double least_share = 1.0;  ///< least vᵀ S v / |v|ᵀ |S| |v| found above `null_share`
  Eigen::VectorXd softest;   ///< the v of least_share; empty if it was not searched for
};

/// Measured energies of mechanisms are below 5e-18 of their terms (one term is rounded to 1e-16). Those of soft motions
/// are above 3e-12 (10 000 beams in a row, stiff next to soft). This limit lies between both.
inline constexpr double null_share = 4e-15;
/// Below this energy share, round-off is more than a thousandth of the energy.
inline constexpr double doubtful_share = 1e-13;

/// A pivot is trusted if it keeps at least this share of its diagonal entry.
inline constexpr double trusted_pivot = 1e-6;

/// Null space of S from `factor`, made by Factor(S). If all pivots keep 1e-6 of their diagonal entries, there is none:
/// at the last coordinate that a motion v moves, the pivot is vᵀ S v/v_j². Otherwise a block of solutions searches for
/// v. If it finds energies below 1e-12, subspace iteration with S + 1e-12 diag(S) decides, which is definite if S is
/// semidefinite.
NullSpace null_space(const Matrix& S, const Factor& factor);

/// Null space of S by search, without trust in the pivots.
NullSpace searched_null_space(const Matrix& S, const Factor& factor);

}  // namespace tisserand::reducer

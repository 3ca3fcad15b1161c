// SPDX-License-Identifier: GPL-3.0-or-later
// Null space of a sparse symmetric stiffness matrix, checked before anything divides by its factor.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/algebra/factor.hpp"
#include "reducer/algebra/symmetric_pair.hpp"

namespace tisserand::reducer {

/// Null space of a stiffness matrix S: motions v whose strain energy is only round-off. vᵀ S v is then at most
/// `null_share` of |v|ᵀ |S| |v|, the sum of the magnitudes of its terms.
struct NullSpace {
  Eigen::MatrixXd vectors;   ///< n x k: basis of the null space, which is the unit matrix at the rows `pivots`
  std::vector<int> pivots;   ///< k coordinates at which the basis is the unit matrix
  int negative = 0;          ///< number of negative eigenvalues of S, if S is indefinite beyond round-off
  double least_share = 1.0;  ///< least vᵀ S v / |v|ᵀ |S| |v| above `null_share` that the search found
  Eigen::VectorXd softest;   ///< motion v with the energy share `least_share`; empty if there was no search
};

/// Limit of the energy share vᵀ S v / |v|ᵀ |S| |v| up to which a motion v has no stiffness. Measured shares of
/// mechanisms are below 5e-18 (one term is rounded to 1e-16). Those of soft motions are above 3e-12 (10 000 beams in a
/// row, stiff next to soft).
inline constexpr double null_share = 4e-15;
/// Energy share vᵀ S v / |v|ᵀ |S| |v| below which round-off is more than a thousandth of the energy of the motion v.
inline constexpr double doubtful_share = 1e-13;

/// Share of its diagonal entry that a pivot of a factorisation must keep to be trusted.
inline constexpr double trusted_pivot = 1e-6;

/// Null space of S. `factor`: the factor Factor(S). If all pivots keep 1e-6 of their diagonal entries, the null space
/// is empty: at the last coordinate j that a motion v moves, the pivot is vᵀ S v/v_j². Otherwise a block of solutions
/// searches for v. If it finds energy shares below 1e-12, subspace iteration with S + 1e-12 diag(S) decides. This
/// matrix is definite if S is semidefinite.
NullSpace null_space(const Matrix& S, const Factor& factor);

/// Null space of S by the search of null_space(), also if all pivots of `factor` could be trusted.
NullSpace searched_null_space(const Matrix& S, const Factor& factor);

}  // namespace tisserand::reducer

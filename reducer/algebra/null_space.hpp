// Null space of a sparse symmetric stiffness: between its factor and all that divides by it.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/algebra/factor.hpp"
#include "reducer/algebra/symmetric_pair.hpp"

namespace tisserand::reducer {

/// Motions v without stiffness: the strain energy vᵀ S v is round-off of its terms, that is at most `null_share` of
/// |v|ᵀ |S| |v|.
struct NullSpace {
  Eigen::MatrixXd vectors;   ///< n x k: a basis that is the unit matrix at `pivots`
  std::vector<int> pivots;   ///< k coordinates
  int negative = 0;          ///< negative eigenvalues of S, if it is indefinite beyond round-off
  double least_share = 1.0;  ///< the least vᵀ S v / |v|ᵀ |S| |v| above `null_share` that was seen
  Eigen::VectorXd softest;   ///< its v; empty: not looked for
};

/// Energies of mechanisms are measured below 5e-18 of their terms (1e-16 is the rounding of one term), those of soft
/// motions above 3e-12 (10 000 beams in a row, stiff beside soft): this lies between.
inline constexpr double null_share = 4e-15;
/// Round-off is more than a thousandth of an energy below this.
inline constexpr double doubtful_share = 1e-13;

/// Share of its diagonal entry that a pivot keeps where it is trusted.
inline constexpr double trusted_pivot = 1e-6;

/// `factor`: of S, by Factor(S). Where all its pivots keep 1e-6 of their diagonal entries there is no null space: at
/// the last coordinate that a motion v moves the pivot is vᵀ S v/v_j². Else one block of solutions looks for v, and if
/// that finds energies below 1e-12, subspace iteration with S + 1e-12 diag(S), which is definite where S is
/// semidefinite, decides.
NullSpace null_space(const Matrix& S, const Factor& factor);

/// The same without trust in the pivots.
NullSpace searched_null_space(const Matrix& S, const Factor& factor);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Strain that rigid motions cause in a superelement, relative to its softest deformations, and the part that rounding
// of entries explains. check() finds wrong positions, signs and units by it.
#pragma once

#include <string>

#include <Eigen/Core>

namespace tisserand::formats {

inline constexpr double rigid_change_accepted = 1e-6;  ///< accepted RigidStrain::change, for any cause
inline constexpr double rigid_change_rounding = 3e-2;  ///< accepted change if rounding explains it; above: Error
inline constexpr double rigid_residual_exact = 1e-13;  ///< max |S R| / max |S| that requires no explanation

/// Bounds of the errors of matrix entries that were written with few digits.
struct EntryErrors {
  Eigen::MatrixXd bound;  ///< (n x n) bounds of |δa_ij|; empty: entries have all digits of double precision
  std::string reason;     ///< "10 digits", "single precision"; empty like `bound`
};

/// Bounds p |a_ij| of the rounding errors of the entries a_ij. For d decimal digits p = ½ 10^(1−d); for single
/// precision p = 2⁻²⁴. In fields of fixed width, where signs and exponents take digits, d is the smallest usual number.
/// Entries with at most four digits are chosen numbers without rounding. 15 digits or more mean double precision.
EntryErrors entry_errors(const Eigen::MatrixXd& matrix);

/// Cause of the forces S R of rigid motions. rounding: all forces are within the errors of entries, 1e-9 of entries and
/// 1e-11 of the largest entry. unexplained: wrong positions, signs or units, or parts fixed to the ground.
enum class RigidStrainCause { rounding, unexplained };

/// Strain that rigid motions r cause in a stiffness matrix S. With S v_j = d_j v_j on the complement of the rigid
/// motions (scaled, |v_j| = |r| = 1):
///   change = max over motions r of √Σ_j (v_jᵀS r)² / (d_j d_1) and |rᵀS r| / d_1, with the least d_1.
/// The first value is the amplitude of v_1 with equal strain, the second the resistance of r relative to v_1. A node
/// misplaced by the fraction δ of the length gives about δ and δ². The projection filter_rigid_motions() changes
/// stiffness and eigenvalues of the softest deformations by at most the order of `change`.
struct RigidStrain {
  double change = 0.0;
  Eigen::Index motion = 0;  ///< column of R: the worst motion, unexplained ones first
  Eigen::Index row = 0;     ///< row of the largest force in that motion
  double force = 0.0;       ///< |S R| at that row
  RigidStrainCause cause = RigidStrainCause::rounding;
};

/// Strain of the rigid motions R (n x 6) by the stiffness S (n x n, symmetric, max |S| about 1), in scaled coordinates.
/// `errors`: bounds of the errors of entries of S (empty: none). Directions with a stiffness below 1e-12 of |S| are
/// internal hinges, not deformations. Cost O(n³): a Cholesky factorisation above 400 coordinates, all eigenvalues
/// below.
RigidStrain rigid_strain(const Eigen::MatrixXd& S, const Eigen::MatrixXd& R, const Eigen::MatrixXd& errors);

}  // namespace tisserand::formats

// How much rigid motions strain a superelement, in terms of its softest deformations, and what rounding of its entries
// explains of that: the judgement of check() on positions, signs and units.
#pragma once

#include <string>

#include <Eigen/Core>

namespace tisserand::formats {

inline constexpr double rigid_change_accepted = 1e-6;  ///< of the softest stiffness, whatever the cause
inline constexpr double rigid_change_rounding = 3e-2;  ///< where rounding of the entries explains it; above: Error
inline constexpr double rigid_residual_exact = 1e-13;  ///< max |S R| / max |S| that no geometry has to explain

/// Largest errors of entries that were written with few digits.
struct EntryErrors {
  Eigen::MatrixXd bound;  ///< |δa_ij|, n x n; empty: entries have all digits of double precision
  std::string reason;     ///< "10 digits", "single precision"; empty like `bound`
};

/// Errors p |a_ij|, p = ½ 10^(1−d) with d the number of decimal digits that the entries have (of fields of fixed width,
/// in which signs and exponents cost digits, the fewest that are usual), or 2⁻²⁴ if they are numbers of single
/// precision. Entries that all have four digits at most are chosen numbers, not rounded ones; 15 digits or more are
/// double precision.
EntryErrors entry_errors(const Eigen::MatrixXd& matrix);

/// Rounding: every force is within what the errors of the entries allow, 1e-9 of them and 1e-11 of the largest.
/// Unexplained: positions, signs, units or the ground.
enum class RigidStrainCause { rounding, unexplained };

/// With S v_j = d_j v_j on the complement of the rigid motions (scaled coordinates, |v_j| = |r| = 1), d_1 the softest:
///   change = max over motions r of √Σ_j (v_jᵀS r)² / (d_j d_1) and |rᵀS r| / d_1.
/// The first is the amplitude of v_1 that strains the part as much as r does, the second what r resists beside v_1. A
/// node in the wrong place by the fraction δ of the length gives about δ and δ². Projection (filter_rigid_motions())
/// changes stiffness and eigenvalues of the softest deformations by no more than the order of `change`.
struct RigidStrain {
  double change = 0.0;
  Eigen::Index motion = 0;  ///< column of R: the worst, of those that rounding does not explain if there are any
  Eigen::Index row = 0;     ///< with the largest force in that motion
  double force = 0.0;       ///< |S R| there
  RigidStrainCause cause = RigidStrainCause::rounding;
};

/// S: n x n symmetric with max |S| about 1, R: n x 6, both in scaled coordinates; `errors` of the entries of
/// S (empty: none). Directions with less than 1e-12 of |S| are hinges within the part, no softest deformation. O(n³):
/// as a Cholesky factorisation above 400 coordinates, as all eigenvalues below.
RigidStrain rigid_strain(const Eigen::MatrixXd& S, const Eigen::MatrixXd& R, const Eigen::MatrixXd& errors);

}  // namespace tisserand::formats

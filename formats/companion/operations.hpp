// What is done with a companion after reading it: one file serves every choice of modes, form, reference, units, image.
//
// The identities are those of the arrays' definitions (formats/COMPANION.md, "Operations"). None of them looks at the
// file; rows are whatever the caller's matrices have.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/companion/companion.hpp"

namespace tisserand::formats {

/// Removes the internal coordinates `rows` (ascending) with fixed-boundary frequencies `omega_squared`. They then
/// follow quasi-statically in N and T:
///   N_a −= Σ_D H_i (M̄ R)_ia/ω_i²,  T_jk −= Σ_D H_i ½[(C_kᵀ R)_i,3+j + (C_jᵀ R)_i,3+k]/ω_i²
/// Needs C as the finite elements give it: before galilean_step(). `mass`, `R`: M̄ and its rigid motions about the
/// reference point (n x 6), all rows. Rows of S̄ that couple to others, or are not diagonal, cannot be dropped so:
/// congruence() first.
void drop_modes(Companion& companion, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& R,
                const std::vector<int>& rows, const Eigen::VectorXd& omega_squared);

/// C_k += (M̄ R_T/m) d_k with d_k = [e_k x] S1 − P_k, P_k = R_Tᵀ C_k: the momentum of a turned shape is that of S1
/// turned, so that equations do not depend on the velocity of the observer. d vanishes for masses that move alike in
/// all directions and is O(h²) for beams with Hermite shapes. E_jk += ½(X_jk + X_jkᵀ)/m, X_jk = P_jᵀ d_k + d_jᵀ P_k +
/// d_jᵀ d_k with P_k of before: [M̄ C; Cᵀ E] stays a Gram matrix.
void galilean_step(Companion& companion, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& R);

/// Moves the reference point to `point` (d = point − reference_point); the caller sets `weights`:
///   N_3+j −= Σ_a (e_j × d)_a N_a,  T_jk −= sym_jk Σ_ab (e_j × d)_a ε_akb N_b,  S0 −= m d
/// Exact for masses that move alike in all directions; T errs by O(h²) for Hermite shapes.
void move_reference(Companion& companion, const Eigen::Vector3d& point);

/// y = A y': H'_j = Σ_i A_ij Aᵀ H_i A, the others Aᵀ . A, S1 A, Aᵀ f. A: n x n', any rank.
void congruence(Companion& companion, const Eigen::MatrixXd& A);

/// The companion of a mirror image (formats/superelement/mirror.hpp): y turns by signs, and the indices a, j, k as
/// vectors: those of N_1..3, S0, S1 by D, of N_4..6, C, E, T by det(D) D. `image`: the mirrored superelement.
void mirror(Companion& companion, const Eigen::Vector3d& axes, const Superelement& image);

/// Numbers in other units. `translation`: which coordinates are lengths; the others (rotations, internal ones) keep
/// their numbers, as those of S̄ and M̄ do.
void convert(Companion& companion, const UnitConversion& units, const std::vector<bool>& translation);

}  // namespace tisserand::formats

// SPDX-License-Identifier: GPL-3.0-or-later
// Operations on a companion after reading: selection of modes, form, reference point, units, mirror image.
//
// They use the definitions of the arrays only (formats/COMPANION.md, "Operations") and do not read the file. Rows are
// those of the caller's matrices.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/companion/companion.hpp"

namespace tisserand::formats {

/// Removes the internal coordinates D = `rows` (ascending) with fixed-boundary frequencies ω_i² = `omega_squared`. In
/// N, T and the stiffness of load cases (force f) these coordinates then follow quasi-statically:
///   N_a −= Σ_D H_i (M̄ R)_ia/ω_i², T_jk −= Σ_D H_i ½[(C_kᵀ R)_i,3+j + (C_jᵀ R)_i,3+k]/ω_i², stiffness −= Σ_D H_i
///   f_i/ω_i²
/// `mass`, `R`: M̄ and its rigid motions about the reference point (n x 6), all rows. Requires a call before
/// galilean_step(), which changes C of the finite elements. Requires that the removed rows of S̄ are diagonal and
/// uncoupled: call congruence() first if they are not.
void drop_modes(Companion& companion, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& R,
                const std::vector<int>& rows, const Eigen::VectorXd& omega_squared);

/// Replaces C so that the momentum of a rotated shape is the rotated S1; equations then do not depend on the observer's
/// velocity. C_k += (M̄ R_T/m) d_k with d_k = [e_k x] S1 − P_k and P_k = R_Tᵀ C_k. m is the mass; R_T are the three
/// rigid translations, the first columns of R. d is zero for masses that move alike in all directions, and O(h²) for
/// Hermite beams with elements of length h. E_jk += ½(X_jk + X_jkᵀ)/m with the old P_k and X_jk = P_jᵀ d_k + d_jᵀ P_k +
/// d_jᵀ d_k keeps [M̄ C; Cᵀ E] a Gram matrix.
void galilean_step(Companion& companion, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& R);

/// Moves the reference point by d = point − reference_point. The caller must set `weights`. m is the mass, ε_akb the
/// permutation symbol.
///   N_3+j −= Σ_a (e_j × d)_a N_a, T_jk −= sym_jk Σ_ab (e_j × d)_a ε_akb N_b, S0 −= m d
/// It is exact for masses that move alike in all directions. For Hermite shapes with elements of length h, T has an
/// error of O(h²).
void move_reference(Companion& companion, const Eigen::Vector3d& point);

/// Substitutes y = A y' for the coordinates y: H'_j = Σ_i A_ij Aᵀ H_i A; other matrices X become Aᵀ X A, S1 becomes S1
/// A, and forces f of load cases become Aᵀ f. A is n x n', of any rank.
void congruence(Companion& companion, const Eigen::MatrixXd& A);

/// Replaces a companion by that of the mirror image under D = diag(axes), each 1 or −1
/// (formats/superelement/mirror.hpp). Coordinates y change signs. Indices a, j, k transform as vectors: N_1..3, S0, S1
/// by D; N_4..6, C, E, T by det(D) D. `image`: the mirrored superelement.
void mirror(Companion& companion, const Eigen::Vector3d& axes, const Superelement& image);

/// Converts a companion to other units. `translation`: whether each coordinate is a length. Other coordinates
/// (rotations, internal ones) keep their numbers, as in S̄ and M̄.
void convert(Companion& companion, const UnitConversion& units, const std::vector<bool>& translation);

}  // namespace tisserand::formats

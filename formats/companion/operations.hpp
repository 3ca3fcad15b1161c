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

/// Removes the internal coordinates `rows` (ascending) with fixed-boundary frequencies `omega_squared`. They then
/// follow quasi-statically in N and T:
///   N_a −= Σ_D H_i (M̄ R)_ia/ω_i²,  T_jk −= Σ_D H_i ½[(C_kᵀ R)_i,3+j + (C_jᵀ R)_i,3+k]/ω_i²
/// Call it before galilean_step(), since it needs C of the finite elements. `mass`, `R`: M̄ and its rigid motions about
/// the reference point (n x 6), all rows. The dropped rows of S̄ must be diagonal and uncoupled: call congruence()
/// first if they are not.
void drop_modes(Companion& companion, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& R,
                const std::vector<int>& rows, const Eigen::VectorXd& omega_squared);

/// Makes the momentum of a turned shape that of S1 turned: C_k += (M̄ R_T/m) d_k, d_k = [e_k x] S1 − P_k,
/// P_k = R_Tᵀ C_k. Then equations do not depend on the observer's velocity. d is zero for masses that move alike in all
/// directions, O(h²) for Hermite beams. E_jk += ½(X_jk + X_jkᵀ)/m with the old P_k and
/// X_jk = P_jᵀ d_k + d_jᵀ P_k + d_jᵀ d_k keeps [M̄ C; Cᵀ E] a Gram matrix.
void galilean_step(Companion& companion, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& R);

/// Moves the reference point to `point`, d = point − reference_point. The caller sets `weights`.
///   N_3+j −= Σ_a (e_j × d)_a N_a,  T_jk −= sym_jk Σ_ab (e_j × d)_a ε_akb N_b,  S0 −= m d
/// Exact for masses that move alike in all directions. For Hermite shapes T has an error of O(h²).
void move_reference(Companion& companion, const Eigen::Vector3d& point);

/// Substitutes y = A y': H'_j = Σ_i A_ij Aᵀ H_i A, other matrices Aᵀ . A, S1 A, Aᵀ f. A: n x n', any rank.
void congruence(Companion& companion, const Eigen::MatrixXd& A);

/// Turns a companion into that of a mirror image (formats/superelement/mirror.hpp). y changes by signs; indices a, j, k
/// as vectors: N_1..3, S0, S1 by D; N_4..6, C, E, T by det(D) D. `image`: the mirrored superelement.
void mirror(Companion& companion, const Eigen::Vector3d& axes, const Superelement& image);

/// Converts to other units. `translation` marks the coordinates that are lengths. The others (rotations, internal ones)
/// keep their numbers, as in S̄ and M̄.
void convert(Companion& companion, const UnitConversion& units, const std::vector<bool>& translation);

}  // namespace tisserand::formats

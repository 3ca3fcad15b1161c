// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary (static constraint) modes: motion of the inside for motions of the boundary, [Car00] eq. (4).
#pragma once

#include <functional>

#include <Eigen/Core>

#include "reducer/algebra/factor.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/system/partition.hpp"

namespace tisserand::reducer {

/// Boundary modes Ψ = −S_II⁻¹ S_IB (n_I x n_B), THEORY (78), and the blocks of the boundary with the inside that
/// follows (n_B x n_B each), THEORY (80).
struct BoundaryModes {
  Eigen::MatrixXd Psi;
  Eigen::MatrixXd S;            ///< S_BB + S_BI Ψ + Ψᵀ (S_IB + S_II Ψ)
  Eigen::MatrixXd M;            ///< M_BB + M_BI Ψ + Ψᵀ X, X = M_IB + M_II Ψ
  Eigen::MatrixXd flexibility;  ///< Xᵀ S_II⁻¹ X
  /// max |R_I − Ψ R_B| (rotations scaled) before rigid motions were made exact: round-off of the solution.
  double rigid_defect = 0.0;
};

/// Solves in blocks, then adds (R_I − Ψ R_B) R_B⁺, so that rigid motions of the boundary move the inside rigidly to the
/// last digit; R = System::R. `share` receives the share that is done.
BoundaryModes boundary_modes(const Factor& S_II, const Blocks& blocks, const System& system, const Partition& p,
                             const std::function<void(double)>& share);

/// Symmetric part of A, without the unsymmetric round-off of products of symmetric factors.
inline Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& A) { return 0.5 * (A + A.transpose()); }

/// M̄_BI of THEORY (80): Xᵀ Φ (n_B x m).
Eigen::MatrixXd mass_coupling(const Blocks& blocks, const BoundaryModes& boundary, const Eigen::MatrixXd& Phi);

}  // namespace tisserand::reducer

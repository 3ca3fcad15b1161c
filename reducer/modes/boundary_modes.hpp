// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary (static constraint) modes: motion of the inside for motions of the boundary, [Car00] eq. (4).
#pragma once

#include <functional>

#include <Eigen/Core>

#include "reducer/algebra/factor.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/system/partition.hpp"

namespace tisserand::reducer {

/// Boundary modes Ψ = −S_II⁻¹ S_IB of THEORY (78), and the boundary blocks of the reduced matrices, THEORY (80). n_B
/// and n_I are the numbers of boundary and interior coordinates. X = M_IB + M_II Ψ is the coupling of the boundary to
/// the mass of the interior.
struct BoundaryModes {
  Eigen::MatrixXd Psi;
  Eigen::MatrixXd S;            ///< n_B x n_B: S_BB + S_BI Ψ + Ψᵀ (S_IB + S_II Ψ), where the bracket is round-off
  Eigen::MatrixXd M;            ///< n_B x n_B: M_BB + M_BI Ψ + Ψᵀ X
  Eigen::MatrixXd flexibility;  ///< n_B x n_B: Xᵀ S_II⁻¹ X, the G of THEORY (88) if no mode is kept
  /// Largest entry of |R_I − Ψ R_B|, R = System::R, before boundary_modes() made rigid motions exact. It is the
  /// round-off of the solution.
  double rigid_defect = 0.0;
};

/// Computes the boundary modes in blocks of columns. Then it adds (R_I − Ψ R_B) R_B⁺ to Ψ, with the rigid motions R =
/// System::R, so that a rigid motion of the boundary moves the interior rigidly to the last digit. `share` receives
/// the completed share of the work, 0 to 1.
BoundaryModes boundary_modes(const Factor& S_II, const Blocks& blocks, const System& system, const Partition& p,
                             const std::function<void(double)>& share);

/// Symmetric part (A + Aᵀ)/2, which removes the unsymmetric round-off of products of symmetric factors.
inline Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& A) { return 0.5 * (A + A.transpose()); }

/// Block M̄_BI = Xᵀ Φ of the reduced mass matrix (n_B x m), THEORY (80). `Phi`: the m internal vectors Φ (n_I x m).
Eigen::MatrixXd mass_coupling(const Blocks& blocks, const BoundaryModes& boundary, const Eigen::MatrixXd& Phi);

}  // namespace tisserand::reducer

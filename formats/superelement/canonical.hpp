// SPDX-License-Identifier: GPL-3.0-or-later
// Canonical form of reduced matrices by congruence, applied to superelements of any form before use.
#pragma once

#include <string>

#include <Eigen/Core>

namespace tisserand::formats {

/// Reduced stiffness and mass matrix of any form, with boundary rows first. The sizes are nb + mf for nb boundary rows
/// and mf internal rows.
struct PartitionedMatrices {
  Eigen::MatrixXd stiffness;  ///< (nb + mf) x (nb + mf)
  Eigen::MatrixXd mass;
  Eigen::Index boundary_size = 0;
};

/// Matrices of the canonical form, THEORY (7): S_BI = 0, M_II = 1, S_II = diag(eigenvalues), ascending. B: boundary
/// rows, I: internal rows. The internal coordinates of the input are y_I = static_part y_B + modal_part η with the new
/// internal coordinates η.
struct CanonicalMatrices {
  Eigen::MatrixXd S_BB;
  Eigen::MatrixXd M_BB;
  Eigen::MatrixXd M_BI;
  Eigen::VectorXd S_II;
  Eigen::MatrixXd static_part;
  Eigen::MatrixXd modal_part;
  Eigen::Index massless =
      /// Number of internal directions without mass. They carry no inertia or weight, and are dropped.
      0;
};

/// Canonical form, THEORY (7), of reduced matrices S (stiffness) and M (mass) by y_I = −S_II⁻¹ S_IB y_B + Q η with S_II
/// Q = M_II Q Λ and QᵀM_II Q = 1. Internal coordinates with zero rows of S (mechanisms of a part) come first with
/// eigenvalue 0. The other internal coordinates are made orthogonal to them in M. No entry is set to zero. Throws Error
/// (at `where`) if S_II is not safely positive definite or M_II is indefinite.
CanonicalMatrices canonical_form(const PartitionedMatrices& matrices, const std::string& where);

/// Number of modes to keep of the ascending list `eigenvalue`: at least `wanted`. Eigenvalues closer than 1e-6
/// (relative) form a cluster, which is not split.
Eigen::Index complete_cluster(const Eigen::VectorXd& eigenvalue, Eigen::Index wanted);

}  // namespace tisserand::formats

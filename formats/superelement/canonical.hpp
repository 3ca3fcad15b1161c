// SPDX-License-Identifier: GPL-3.0-or-later
// Canonical form of reduced matrices by congruence, applied to superelements of any form before use.
#pragma once

#include <string>

#include <Eigen/Core>

namespace tisserand::formats {

/// Reduced matrices of any form, with boundary rows first.
struct PartitionedMatrices {
  Eigen::MatrixXd stiffness;  ///< (nb + mf)²
  Eigen::MatrixXd mass;
  Eigen::Index boundary_size = 0;
};

/// Canonical form: S_BI = 0, M_II = 1, S_II = diag(eigenvalue) ascending; y_I(input) = static_part y_B + modal_part η.
struct CanonicalMatrices {
  Eigen::MatrixXd S_BB;
  Eigen::MatrixXd M_BB;
  Eigen::MatrixXd M_BI;
  Eigen::VectorXd S_II;
  Eigen::MatrixXd static_part;
  Eigen::MatrixXd modal_part;
  Eigen::Index massless =
      0;  ///< number of internal directions without mass, which carry no inertia or weight and are dropped
};

/// Canonical form (THEORY (7)) by y_I = −S_II⁻¹ S_IB y_B + Q η with S_II Q = M_II Q Λ and QᵀM_II Q = 1. Coordinates
/// with zero rows of S (mechanisms of a part) come first with eigenvalue 0; the others are made orthogonal to them in
/// M. No entry is set to zero. Throws Error (at `where`) if S_II is not safely positive definite or M_II is indefinite.
CanonicalMatrices canonical_form(const PartitionedMatrices& matrices, const std::string& where);

/// Number of modes to keep of `eigenvalue` (ascending): at least `wanted`, without splitting a cluster of eigenvalues
/// closer than 1e-6 (relative).
Eigen::Index complete_cluster(const Eigen::VectorXd& eigenvalue, Eigen::Index wanted);

}  // namespace tisserand::formats

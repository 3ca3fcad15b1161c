// Canonical form of reduced matrices by congruence: between a superelement of any form and its use.
#pragma once

#include <string>

#include <Eigen/Core>

namespace tisserand::formats {

/// Reduced matrices with boundary rows first. Any form on input.
struct PartitionedMatrices {
  Eigen::MatrixXd stiffness;  ///< (nb + mf)²
  Eigen::MatrixXd mass;
  Eigen::Index boundary_size = 0;
};

/// S_BI = 0, M_II = 1, S_II = diag(eigenvalue) ascending; y_I(input) = static_part y_B + modal_part η.
struct CanonicalMatrices {
  Eigen::MatrixXd S_BB;
  Eigen::MatrixXd M_BB;
  Eigen::MatrixXd M_BI;
  Eigen::VectorXd S_II;
  Eigen::MatrixXd static_part;
  Eigen::MatrixXd modal_part;
  Eigen::Index massless =
      0;  ///< internal directions without mass: they carry no inertia and no weight and are left out
};

/// Coordinates without stiffness, whose rows of S are zero (mechanisms of a part), come first with the eigenvalue 0;
/// the others are made orthogonal to them in M. Else congruence with y_I = −S_II⁻¹ S_IB y_B + Q η, where S_II Q = M_II
/// Q Λ and QᵀM_II Q = 1. Nothing is zeroed. Throws Error (at `where`) if S_II is not safely positive definite or M_II
/// is indefinite.
CanonicalMatrices canonical_form(const PartitionedMatrices& matrices, const std::string& where);

/// Number of modes to keep of `eigenvalue` (ascending) so that at least `wanted` are kept and no cluster of eigenvalues
/// closer than 1e-6 (relative) is split.
Eigen::Index complete_cluster(const Eigen::VectorXd& eigenvalue, Eigen::Index wanted);

}  // namespace tisserand::formats

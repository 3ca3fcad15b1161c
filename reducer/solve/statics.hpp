// SPDX-License-Identifier: GPL-3.0-or-later
// Linear statics of the supported part: one factor for all load cases.
#pragma once

#include "reducer/loads/load_vectors.hpp"
#include "reducer/solve/supported.hpp"

namespace tisserand::reducer {

/// Static solution of the supported part for all load cases.
struct Statics {
  Eigen::MatrixXd q;  ///< displacements: coordinates x cases
  /// S q − f on the held coordinates (held coordinates in the order of Partition::boundary x cases).
  Eigen::MatrixXd reaction;
  /// For each case: max |S q − f|_i / (|S| |q| + |f|)_i over the free coordinates i, after refinement.
  Eigen::VectorXd residual;
  Eigen::VectorXd energy;  ///< strain energy ½ qᵀ S q of each case
};

/// Solves S q = f for all load cases, with refinement. Without supports every load must be in equilibrium, to 1e-8 of
/// its size; otherwise Error is thrown with the imbalance. The displacement then has no mean motion: Rᵀ M q = 0 for
/// the rigid motions R (Rᵀ q = 0 without mass).
Statics statics(const Supported& s, const LoadVectors& loads);

}  // namespace tisserand::reducer

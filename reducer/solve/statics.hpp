// SPDX-License-Identifier: GPL-3.0-or-later
// Linear statics of the supported part: one factor for all load cases.
#pragma once

#include "reducer/loads/load_vectors.hpp"
#include "reducer/solve/supported.hpp"

namespace tisserand::reducer {

struct Statics {
  Eigen::MatrixXd q;         ///< displacements: coordinates x cases
  Eigen::MatrixXd reaction;  ///< S q − f on the held coordinates, in the order of Partition::boundary, x cases
  Eigen::VectorXd residual;  ///< max |S q − f|_i / (|S| |q| + |f|)_i over the free coordinates, after refinement
  Eigen::VectorXd energy;    ///< ½ qᵀ S q
};

/// Solves S q = f with refinement. Without supports every load must be in equilibrium, to 1e-8 of its size, and the
/// displacement has no mean motion: Rᵀ M q = 0 (Rᵀ q = 0 without mass). Otherwise throws Error with the imbalance.
Statics statics(const Supported& s, const LoadVectors& loads);

}  // namespace tisserand::reducer

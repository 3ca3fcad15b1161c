// SPDX-License-Identifier: GPL-3.0-or-later
// Twelve inertia loads of a floating frame, and the static answers of the part in addition to its internal coordinates.
#pragma once

#include <Eigen/Core>

#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// Displacements of q under forces on q with the boundary held, minus the share of the kept modes: w = K_II⁻¹ g − Φ_I
/// Λ⁻¹ Φ_Iᵀ g of THEORY (95).
Eigen::MatrixXd residual_displacements(const ReducedPart& part, const Eigen::MatrixXd& force);

/// Static answers THEORY (95) to the twelve loads THEORY (94) about a point of the part frame.
struct InertiaAnswers {
  Eigen::Vector3d reference_point = Eigen::Vector3d::Zero();
  Eigen::MatrixXd x;      ///< displacements of all coordinates of the mesh x 12
  Eigen::MatrixXd share;  ///< m x 12: Φ_Iᵀ g; 0 for mechanisms, which have no static answer
  Eigen::MatrixXd force;  ///< q x 12: g
};

InertiaAnswers inertia_answers(const ReducedPart& part, const Eigen::Vector3d& reference_point);

}  // namespace tisserand::reducer

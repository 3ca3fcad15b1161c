// SPDX-License-Identifier: GPL-3.0-or-later
// Twelve inertia loads of a floating frame, and the static answers of the part in addition to its internal coordinates.
#pragma once

#include <Eigen/Core>

#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// Static displacements w of the coordinates q under forces g on q with the boundary held, without the share of the
/// kept modes: w = S_II⁻¹ g − Φ_I Λ⁻¹ Φ_Iᵀ g of THEORY (95). `force`: forces g in columns (q x loads).
Eigen::MatrixXd residual_displacements(const ReducedPart& part, const Eigen::MatrixXd& force);

/// Static displacements of THEORY (95) under the twelve inertia loads g of THEORY (94) about a point of the part
/// frame.
struct InertiaAnswers {
  Eigen::Vector3d reference_point = Eigen::Vector3d::Zero();
  Eigen::MatrixXd x;      ///< coordinates of the mesh x 12: displacements
  Eigen::MatrixXd share;  ///< m x 12: share Φ_Iᵀ g of the internal modes; 0 for mechanisms, which have no static answer
  Eigen::MatrixXd force;  ///< q x 12: loads g
};

InertiaAnswers inertia_answers(const ReducedPart& part, const Eigen::Vector3d& reference_point);

}  // namespace tisserand::reducer

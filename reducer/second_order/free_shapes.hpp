// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic modes of the free reduced body, scaled by their strain energy.
#pragma once

#include <Eigen/Core>

#include "formats/superelement/superelement.hpp"

namespace tisserand::reducer {

/// Shapes with the strain energy ½ zᵀz, the lowest last: z = P y, y = Z z.
struct FreeShapes {
  Eigen::MatrixXd Z;      ///< n x p
  Eigen::MatrixXd P;      ///< p x n, P R = 0
  Eigen::VectorXd lower;  ///< p, ascending to 1: ω₁/ω of each shape; 0 for shapes without mass
};

/// The p lowest elastic modes of the free reduced body, or all if there are fewer. A rigid motion may lack mass, unlike
/// in free_modes().
FreeShapes lowest_shapes(const formats::Superelement& element, int p);

}  // namespace tisserand::reducer

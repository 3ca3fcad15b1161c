// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic modes of the free reduced body, scaled by their strain energy.
#pragma once

#include <Eigen/Core>

#include "formats/superelement/superelement.hpp"

namespace tisserand::reducer {

/// The p lowest elastic modes of the free reduced body, scaled to the strain energy ½ zᵀz of their amplitudes z. The
/// lowest is the last. z = P y gives amplitudes of coordinates y, and y = Z z the reverse.
struct FreeShapes {
  Eigen::MatrixXd Z;      ///< n x p: shapes; y = Z z
  Eigen::MatrixXd P;      ///< p x n; P R = 0 for rigid motions R
  Eigen::VectorXd lower;  ///< p, ascending to 1: ω₁/ω of each shape, ω₁ of the lowest; 0 for shapes without mass
};

/// Computes the `p` lowest elastic modes of the free reduced body, or all if there are fewer. Rigid motions without
/// mass are allowed, unlike in free_modes().
FreeShapes lowest_shapes(const formats::Superelement& element, int p);

}  // namespace tisserand::reducer

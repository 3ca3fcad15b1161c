// SPDX-License-Identifier: GPL-3.0-or-later
// Lowest modes of the free reduced part on the full model, for estimates of its accuracy.
#pragma once

#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// Elastic modes of the reduced part, expanded to the coordinates q of the unreduced part, with qᵀ M q = 1.
struct FreeMotions {
  bool boundary_held = false;  ///< true: modes with the boundary held, because free modes cannot be computed
  Eigen::VectorXd lambda;      ///< ω² of the modes, ascending
  Eigen::MatrixXd q;
};

/// Computes the `most` lowest elastic modes y of (S̄, M̄) of the free reduced part, and expands them by q_B = y_B, q_I
/// = Ψ y_B + Φ y_I, THEORY (79). If free modes cannot be computed, it takes the internal modes with the boundary held
/// instead. Reasons are a mechanism in the part and a rigid motion without mass.
FreeMotions free_motions(const ReducedPart& part, int most);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Lowest modes of the free reduced part on the full model, for estimates of its accuracy.
#pragma once

#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// Elastic modes in the system's coordinates q, qᵀ M q = 1.
struct FreeMotions {
  bool boundary_held = false;  ///< true: internal modes, since no elastic modes of the free part can be computed
  Eigen::VectorXd lambda;      ///< ω², ascending
  Eigen::MatrixXd q;
};

/// q_B = y_B, q_I = Ψ y_B + Φ y_I for the `most` lowest elastic modes y of (S̄, M̄) of the free part. If these do not
/// exist (something loose, a rigid motion without mass): those with the boundary held.
FreeMotions free_motions(const ReducedPart& part, int most);

}  // namespace tisserand::reducer

// The lowest modes of the free reduced part on the full model, with which its accuracy is checked.
#pragma once

#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// Elastic modes in the system's coordinates q, qᵀ M q = 1.
struct FreeMotions {
  bool boundary_held = false;  ///< the internal modes, since the free part has no elastic ones that can be computed
  Eigen::VectorXd lambda;      ///< ω², ascending
  Eigen::MatrixXd q;
};

/// q_B = y_B, q_I = Ψ y_B + Φ y_I for the `most` lowest elastic modes y of (S̄, M̄) with nothing held. Where these do not
/// exist (something loose, a rigid motion without mass) those of the held boundary.
FreeMotions free_motions(const ReducedPart& part, int most);

}  // namespace tisserand::reducer

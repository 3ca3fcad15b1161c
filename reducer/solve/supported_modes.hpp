// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of the unreduced part on its supports, or of the free part.
#pragma once

#include <functional>
#include <optional>

#include "reducer/modes/spectrum.hpp"
#include "reducer/solve/supported.hpp"

namespace tisserand::reducer {

struct SupportedModes {
  int rigid = 0;           ///< six for the free part: rigid motions, which `lambda` and `q` omit
  Eigen::VectorXd lambda;  ///< ω², ascending
  Eigen::MatrixXd q;       ///< coordinates x modes, qᵀ M q = 1
  /// 6 x modes: (R_kᵀ M q)², mass and moments of inertia about the centre of mass that a motion of the supports along
  /// axis k excites in each mode. Their sum is that of the part minus what the supports carry themselves.
  Eigen::MatrixXd effective;
  std::optional<int> counted;
  SolverReport solver;
};

/// The `count` lowest modes; a group of equal frequencies is completed. `asked` chooses the solver. `share` receives
/// the share of the search that is done. Throws Error if fewer exist.
SupportedModes supported_modes(const Supported& s, int count, const formats::ModeSelection& asked,
                               const std::function<void(double)>& share);

}  // namespace tisserand::reducer

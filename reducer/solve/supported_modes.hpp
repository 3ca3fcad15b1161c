// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of the unreduced part on its supports, or of the free part.
#pragma once

#include <functional>
#include <optional>

#include "reducer/modes/spectrum.hpp"
#include "reducer/solve/supported.hpp"

namespace tisserand::reducer {

/// Modes of the supported part, with their effective masses.
struct SupportedModes {
  int rigid = 0;           ///< number of rigid motions, which `lambda` and `q` omit: six for the free part
  Eigen::VectorXd lambda;  ///< ω² of the modes, ascending
  Eigen::MatrixXd q;       ///< modes in coordinates q (q x modes), qᵀ M q = 1
  /// Effective mass (R_kᵀ M q)² of each mode q in the rigid motions R_k (6 x modes): mass, and moments of inertia
  /// about the centre of mass. A motion of the supports along axis k excites this mass. The sum over all modes is that
  /// of the part minus what the supports carry themselves.
  Eigen::MatrixXd effective;
  std::optional<int> counted;
  SolverReport solver;
};

/// Computes the `count` lowest modes of the unreduced part on its supports, or of the free part. A group of equal
/// frequencies is completed. `asked` chooses the solver. `share` receives the completed share of the search, 0 to 1.
/// Throws Error if fewer modes exist.
SupportedModes supported_modes(const Supported& s, int count, const formats::ModeSelection& asked,
                               const std::function<void(double)>& share);

}  // namespace tisserand::reducer

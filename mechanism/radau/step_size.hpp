// SPDX-License-Identifier: GPL-3.0-or-later
// Size of the next step of Radau IIA from the errors of this step and of the previous one (Gustafsson).
#pragma once

#include "formats/scene/scene.hpp"

namespace tisserand::mechanism::radau {

/// Parameters of RADAU5 [HW96] IV.8: Newton's iterations and tolerance, limits of the change of step, limits up to
/// which steps and tangents are kept.
struct Tuning {
  int most_iterations = 7;
  double newton_share = 0.03;  ///< limit of remaining increments: min(this, tolerance^(1/2)) of the tolerance
  double safety = 0.9;
  double most_growth = 8.0, most_reduction = 0.2;
  double keep_growth = 1.2;   ///< steps that would grow by less stay, and keep their factors
  double renew_rate = 0.001;  ///< contraction of Newton's iteration above which tangents are renewed
};

/// Error control for the estimate, which has order 3. A tolerance tol on the error of a step of order 5 corresponds to
/// 0.1 tol^(2/3) of the estimate, as in RADAU5.
formats::ErrorControl estimate_tolerance(const formats::ErrorControl& control);

/// Data of the last steps for the size of the next one.
struct StepSize {
  double last_step = 0.0;  ///< last accepted step; 0: none
  double last_error = 0.0;
  bool rejected = false;  ///< the previous step was rejected
  void forget() { *this = {}; }

  /// Next step after an accepted one with the error ratio `error`, `iterations`, and the `contraction` of the last
  /// iteration.
  double after(const Tuning& tuning, double step, double error, int iterations, double contraction);
  /// Step to try instead of one that was too inaccurate.
  double instead(const Tuning& tuning, double step, double error, int iterations);
};

}  // namespace tisserand::mechanism::radau

// SPDX-License-Identifier: GPL-3.0-or-later
// Size of the next step of Radau IIA from the errors of this step and of the previous one (Gustafsson).
#pragma once

#include "formats/scene/scene.hpp"

namespace tisserand::mechanism::radau {

/// Parameters of the step control, as in RADAU5 [HW96] IV.8: Newton's iterations and tolerance, limits of the change of
/// the step, and limits up to which steps and tangents are kept.
struct Tuning {
  int most_iterations = 7;
  /// Limit of the remaining increments of Newton's iteration, as a share of the tolerance τ of the estimate. The root
  /// of τ replaces it if that is smaller.
  double newton_share = 0.03;
  double safety = 0.9;
  double most_growth = 8.0, most_reduction = 0.2;
  double keep_growth = 1.2;   ///< steps that would grow by less stay
  double renew_rate = 0.001;  ///< contraction of Newton's iteration that renews tangents
};

/// Error control for the estimate, which has order 3. A tolerance τ on the error of a step of order 5 corresponds to
/// 0.1 τ^(2/3) of the estimate, as in RADAU5.
formats::ErrorControl estimate_tolerance(const formats::ErrorControl& control);

/// Data of the last steps, from which the length of the next one follows.
struct StepSize {
  double last_step = 0.0;  ///< length of the last accepted step; 0: none
  double last_error = 0.0;
  bool rejected = false;  ///< the previous step was rejected
  void forget() { *this = {}; }

  /// Length of the next step after an accepted one of length `step`. `error`: its error ratio. `iterations`: Newton
  /// iterations. `contraction`: contraction of Newton's iteration.
  double after(const Tuning& tuning, double step, double error, int iterations, double contraction);
  /// Length of the step to try after a step of length `step` whose error ratio `error` is too large.
  double instead(const Tuning& tuning, double step, double error, int iterations);
};

}  // namespace tisserand::mechanism::radau

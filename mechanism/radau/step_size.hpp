// Size of the next step of Radau IIA from the error of this one and of the one before (Gustafsson).
#pragma once

#include "formats/scene/scene.hpp"

namespace tisserand::mechanism::radau {

/// Numbers of RADAU5 [HW96] IV.8: Newton's iterations and tolerance, limits of the change of step, when steps and
/// tangents are kept.
struct Tuning {
  int most_iterations = 7;
  double newton_share = 0.03;  ///< increments still to come may have min(this, tolerance^(1/2)) of the tolerance
  double safety = 0.9;
  double most_growth = 8.0, most_reduction = 0.2;
  double keep_growth = 1.2;   ///< steps that would grow by less stay, and keep their factors
  double renew_rate = 0.001;  ///< contraction of Newton's iteration above which tangents are renewed
};

/// `error_control` as the method applies it. Its estimate is of order 3: a tolerance tol on the error of a step of
/// order 5 asks for 0.1 tol^(2/3) of the estimate, as RADAU5 transforms it.
formats::ErrorControl estimate_tolerance(const formats::ErrorControl& control);

/// What the size of the next step remembers.
struct StepSize {
  double last_step = 0.0;  ///< accepted, 0: none
  double last_error = 0.0;
  bool rejected = false;  ///< the step before was
  void forget() { *this = {}; }

  /// After an accepted step with the ratio of error `error`, reached with so many iterations; `contraction` of the
  /// last.
  double after(const Tuning& tuning, double step, double error, int iterations, double contraction);
  /// Instead of one that was too inaccurate.
  double instead(const Tuning& tuning, double step, double error, int iterations);
};

}  // namespace tisserand::mechanism::radau

// When factors are kept from step to step: learnt from how long they served.
#pragma once

#include <algorithm>

#include "mechanism/step/tuning.hpp"

namespace tisserand::mechanism {

/// Factors that age within a few steps are not worth keeping for a while: after each failure the pause doubles.
struct FactorReuse {
  int kept = 0;   ///< steps that the present factors have served
  int fresh = 0;  ///< steps to take with new factors after the latest failure
  int fresh_left = 0;

  /// Whether the next step tries the factors that are there, which belong to its matrix; counts the pause down.
  bool tries_kept() {
    if (fresh_left == 0) return true;
    --fresh_left;
    return false;
  }
  void succeeded() { ++kept; }
  void failed(const StepTuning& tuning) {
    fresh = kept >= tuning.long_life ? 0 : std::min(2 * fresh + 1, tuning.longest_pause);
    fresh_left = fresh;
    kept = 0;
  }
};

}  // namespace tisserand::mechanism

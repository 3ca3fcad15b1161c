// SPDX-License-Identifier: GPL-3.0-or-later
// Work space of a run besides model and state: evaluation, iteration matrix, memory of previous steps.
#pragma once

#include <algorithm>

#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/step/dissipation.hpp"
#include "mechanism/step/position_projection.hpp"
#include "mechanism/step/predictor.hpp"
#include "mechanism/step/redundancy.hpp"
#include "mechanism/step/tuning.hpp"

namespace tisserand::mechanism {

/// Decision whether a step tries the factors of earlier steps. If factors serve only a few steps, a pause with new
/// factors follows, which doubles after each failure.
struct FactorReuse {
  int kept = 0;   ///< steps that the present factors have served
  int fresh = 0;  ///< steps to take with new factors after the latest failure
  int fresh_left = 0;

  /// Whether the next step tries the existing factors. Counts down the pause, so it must be called once per step.
  /// Requires that the factors belong to the matrix of the step.
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

/// Data that a step keeps from previous steps, besides the factors of the iteration matrix. They influence the
/// convergence of a step, not the solution.
struct StepMemory {
  explicit StepMemory(const Model& model)
      : previous(model.sizes), predictor(model.sizes), dissipation(model), rows(model) {}
  void forget() {
    reuse = {};
    predictor.forget();
    projection.forget();
    dissipation.forget();
  }

  State previous;  ///< state at the start of the step: the last accepted one
  Predictor predictor;
  FactorReuse reuse;
  PositionProjection projection;
  Dissipation dissipation;
  RowWatch rows;
  StepTuning tuning;
};

/// Work space of a run besides model and state: evaluation, iteration matrix, and memory of previous steps.
struct Workspace {
  explicit Workspace(const Model& model) : now(model), matrix(model), memory(model) {}
  /// Discards factors and predictors: the next step works like the first one. So a run that continues from a copy of
  /// the state in another workspace takes bit-equal steps (tests/verification/checkpoint_test.cpp).
  void forget() {
    matrix.forget();
    memory.forget();
  }

  Evaluation now;
  IterationMatrix matrix;
  StepMemory memory;
};

}  // namespace tisserand::mechanism

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

/// Decides whether factors are kept. If they serve only a few steps, a pause follows, which doubles after each failure.
struct FactorReuse {
  int kept = 0;   ///< steps that the present factors have served
  int fresh = 0;  ///< steps to take with new factors after the latest failure
  int fresh_left = 0;

  /// Whether the next step tries the existing factors, which belong to its matrix. Counts down the pause.
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

struct Workspace {
  explicit Workspace(const Model& model) : now(model), matrix(model), memory(model) {}
  /// Discards factors and predictors: the next step works like the first. So a run continued from a copy of the state
  /// in another workspace takes bit-equal steps (tests/verification/checkpoint_test.cpp).
  void forget() {
    matrix.forget();
    memory.forget();
  }

  Evaluation now;
  IterationMatrix matrix;
  StepMemory memory;
};

}  // namespace tisserand::mechanism

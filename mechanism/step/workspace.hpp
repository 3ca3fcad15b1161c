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

/// Factors of an iteration. `kept`: those of earlier steps. `fresh`: made in this step, and again in every iteration
/// that does not converge quickly.
enum class Factors { kept, fresh };

/// Decision whether a step tries the factors of earlier steps. It compares costs, which are counted in iterations. With
/// older factors a step takes more iterations. New ones are made when a step costs more than the mean of all steps
/// since the last factorisation, which makes that mean nearly as small as possible. Kept factors are a loss if they
/// served no step, or if the mean is far above the cost of a step with new factors. Then some steps take new factors at
/// once; their number doubles with each loss.
struct FactorReuse {
  double fresh_cost = 0.0;  ///< cost of the latest step with new factors, with their factorisations
  double spent = 0.0;       ///< cost of all steps since then, with that one
  double steps = 1.0;       ///< number of these steps
  int fresh = 0;            ///< steps to take with new factors after the latest loss
  int fresh_left = 0;

  /// Whether the next step tries the existing factors. Counts down the pause, so it must be called once per step.
  /// Requires that the factors belong to the matrix of the step.
  bool tries_kept() {
    if (fresh_left == 0) return true;
    --fresh_left;
    return false;
  }
  /// Counts an attempt of a step and its cost.
  void count(Factors factors, bool succeeded, double cost, const StepTuning& tuning) {
    if (factors == Factors::fresh) {
      if (succeeded) *this = {cost, cost, 1.0, fresh, fresh_left};
      return;
    }
    const bool cheap = succeeded && cost <= spent / steps;
    spent += cost;
    if (succeeded) steps += 1.0;
    if (cheap) return;
    const bool lost = steps == 1.0 || spent > steps * fresh_cost * tuning.loss;
    fresh = lost ? std::min(2 * fresh + 1, tuning.longest_pause) : 0;
    fresh_left = succeeded ? std::max(fresh, 1) : fresh;
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

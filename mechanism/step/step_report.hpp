// SPDX-License-Identifier: GPL-3.0-or-later
// Report of one step as a structure and as text.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Outcome of a step: accepted, or the reason why it failed.
enum class StepOutcome { accepted, singular, diverged, too_many_iterations, inaccurate };

/// Report of one step. Ratios are measured values divided by their limits, at most 1 when the step is accepted.
struct StepReport {
  StepOutcome outcome = StepOutcome::accepted;
  int iterations = 0;
  int factorisations = 0;
  double force_ratio = 0.0;
  double constraint_ratio = 0.0;
  double error_ratio = 0.0;  ///< ratio of the estimated local error, if controlled
  /// Length of the next step, or the length to try instead, if the method controls its steps itself.
  double proposed = 0.0;
  double residual = 0.0;      ///< largest |r|; moments divided by the length of the model
  double constraint = 0.0;    ///< largest |Φ|; angles times the length of the model
  int worst_coordinate = -1;  ///< coordinate of the largest residual, when not accepted
  int worst_constraint = -1;  ///< row of the largest violation, when not accepted and larger in ratio
  int singular_column = -1;
  /// Adds the counts of iterations and factorisations of a previous attempt at this step.
  void count(const StepReport& before) {
    iterations += before.iterations;
    factorisations += before.factorisations;
  }
  int row_choices = 0;  ///< number of times that the active constraint rows were chosen again
};

/// Text that explains why a step was not accepted: the reason with the worst coordinate or constraint, and a likely
/// cause.
std::string explain(const Model& model, const StepReport& report);

}  // namespace tisserand::mechanism

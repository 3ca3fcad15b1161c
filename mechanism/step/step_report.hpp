// SPDX-License-Identifier: GPL-3.0-or-later
// Report of one step as a structure and as text.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

enum class StepOutcome { accepted, singular, diverged, too_many_iterations, inaccurate };

/// Report of one step. Ratios are measured values divided by their tolerance: at most 1 when accepted.
struct StepReport {
  StepOutcome outcome = StepOutcome::accepted;
  int iterations = 0;
  int factorisations = 0;
  double force_ratio = 0.0;
  double constraint_ratio = 0.0;
  double error_ratio = 0.0;   ///< ratio of the estimated local error, with error control
  double proposed = 0.0;      ///< next step, or the one to try instead, if the method controls its steps itself
  double residual = 0.0;      ///< largest |r| of force rows, and of moment rows / length
  double constraint = 0.0;    ///< largest |Φ| (positions, and angles times length)
  int worst_coordinate = -1;  ///< coordinate of the largest residual, when not accepted
  int worst_constraint = -1;  ///< row of the largest violation, when not accepted and larger in ratio
  int singular_column = -1;
  /// Adds the counts of a previous attempt.
  void count(const StepReport& before) {
    iterations += before.iterations;
    factorisations += before.factorisations;
  }
  int row_choices = 0;  ///< number of times that the active constraint rows were chosen again
};

/// Text on a step that was not accepted: the reason with the worst coordinate or constraint, and a likely cause.
std::string explain(const Model& model, const StepReport& report);

}  // namespace tisserand::mechanism

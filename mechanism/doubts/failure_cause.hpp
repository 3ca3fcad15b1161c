// SPDX-License-Identifier: GPL-3.0-or-later
// Cause of the end of a run: a decision on measured numbers, and the setting that would help.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/doubts/doubts.hpp"
#include "mechanism/step/step_report.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Failure of a run of generalised alpha or HHT after the last accepted step.
struct Failure {
  StepReport step;    ///< report of the last attempt
  double size = 0.0;  ///< size of the step that was tried first
};

/// Sentences on the probable cause of a failure and its remedy, which begin with ". ". Empty if the last step was only
/// inaccurate. The causes are checked in this order, and the first one found is named. First are the explanations of
/// the validity checks (`doubts`) and drives that joints cannot follow with the step tried first. Next are a nearly
/// rank-deficient constraint Jacobian, and an iteration matrix that is singular with the step tried first. Last is a
/// motion that changes much per step. `state`: last accepted state. Overwrites the evaluation and the matrix.
std::string failure_cause(const Model& model, const formats::IntegratorSpec& options, const Doubts& doubts,
                          const Failure& failure, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

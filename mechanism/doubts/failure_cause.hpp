// SPDX-License-Identifier: GPL-3.0-or-later
// Cause of the end of a run: a decision on measured numbers, and the setting that would help.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/doubts/doubts.hpp"
#include "mechanism/step/step_report.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Failure of a run of generalised alpha or HHT, after its last step at the accepted `state`.
struct Failure {
  StepReport step;    ///< report of the last attempt
  double size = 0.0;  ///< size of the step that was tried first
};

/// Text "; <cause>: <remedy>" of the first cause found. Checked are oscillating multipliers, torsion too soft for the
/// spin, drives that joints cannot follow with the step first tried, and a nearly rank-deficient constraint Jacobian.
/// Next are an iteration matrix that is singular with the step first tried (perhaps with a quarter of it), and a motion
/// that changes much per step. Empty: none of these. Overwrites the evaluation and the matrix.
std::string failure_cause(const Model& model, const formats::IntegratorSpec& options, const Doubts& doubts,
                          const Failure& failure, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

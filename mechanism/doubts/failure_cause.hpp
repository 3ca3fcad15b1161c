// Why a run had to end: a decision on measured numbers, and the setting that would help.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/doubts/doubts.hpp"
#include "mechanism/step/step_report.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// What a run of generalised alpha or HHT failed at, after its last step at the accepted `state`.
struct Failure {
  StepReport step;    ///< of the last attempt
  double size = 0.0;  ///< of the step that was first tried there
};

/// "; <cause>: <remedy>", asked in this order: multipliers that swing; torsion too soft for the spin; drives that
/// joints cannot follow, with the step first tried; a constraint Jacobian that is nearly of lower rank at the state; an
/// iteration matrix that is singular there with the step first tried, and with a quarter of it or not; a motion that
/// changes much per step. Empty: none of these. Overwrites the evaluation and the matrix.
std::string failure_cause(const Model& model, const formats::IntegratorSpec& options, const Doubts& doubts,
                          const Failure& failure, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

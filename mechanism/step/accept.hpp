// SPDX-License-Identifier: GPL-3.0-or-later
// Work before and after Newton's iteration of a step: factors of the projection, local error, data of an accepted
// state, and the choice of other constraint rows.
#pragma once

#include "mechanism/step/newton.hpp"

namespace tisserand::mechanism {

/// Stores in an accepted state the unit quaternions, frames, unwrapped angles and force scales of its evaluation.
void settle(const Model& model, const Evaluation& now, State& state);

/// Prepares a step at its first state: the deformation of damped bodies, and the factors of the position projection if
/// it has one. Returns false with the outcome if the matrix is singular.
bool begin(const Model& model, const StepScheme& scheme, const State& state, Workspace& workspace, StepReport& report);

/// Accepts the solution of a step as the state and updates predictors. If its error is too large, sets the outcome
/// `inaccurate` and restores the state.
void finish(Iteration& it);

/// Whether the rank of the constraints may have changed in the step: omitted rows are violated, or an overconstrained
/// or singular step failed.
bool rows_are_doubtful(const Model& model, const StepReport& report, const State& state, const Evaluation& evaluation);

/// Chooses other constraint rows before a step if the active ones are nearly dependent (RowWatch). Returns whether they
/// changed.
bool renew_rows(const Model& model, State& state, Workspace& workspace);

/// Returns to the start of the failed step and chooses other rows. First it takes those that are independent there,
/// since old ones may have become dependent and the end satisfies nothing. If this gives nothing new (the step left a
/// position of lower rank), it takes those that are independent at the end. Returns false with the state unchanged if
/// the rows stay.
bool choose_rows_again(const Model& model, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

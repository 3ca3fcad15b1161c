// SPDX-License-Identifier: GPL-3.0-or-later
// Work before and after Newton's iteration of a step: factors of the projection, local error, data of an accepted
// state, and the choice of other constraint rows.
#pragma once

#include "mechanism/step/newton.hpp"

namespace tisserand::mechanism {

/// Stores in an accepted state what follows from its evaluation: unit quaternions, frames, unwrapped angles and running
/// maxima of forces.
void settle(const Model& model, const Evaluation& now, State& state);

/// Prepares a step at its first state: stores the deformation of damped bodies, and makes the factors of the position
/// projection if the step has one. Returns false and sets report.outcome if the matrix is singular.
bool begin(const Model& model, const StepScheme& scheme, const State& state, Workspace& workspace, StepReport& report);

/// Accepts the solution of a step as the state and updates predictors. If the local error is too large, it sets the
/// outcome `inaccurate` and restores the state.
void finish(Iteration& it);

/// Whether the rank of the constraints may have changed in the step. That is so if omitted rows are violated, or if an
/// overconstrained or singular step failed.
bool rows_are_doubtful(const Model& model, const StepReport& report, const State& state, const Evaluation& evaluation);

/// Chooses other constraint rows before a step if the active rows are nearly dependent (RowWatch). Returns whether the
/// rows changed.
bool renew_rows(const Model& model, State& state, Workspace& workspace);

/// Returns to the start of a failed step and chooses other constraint rows. First it takes rows that are independent at
/// the start, since old ones may have become dependent there. If these are the old rows or fewer, it takes rows that
/// are independent at the end; the step then left a position of lower rank. Returns false, with the state unchanged, if
/// the rows stay.
bool choose_rows_again(const Model& model, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

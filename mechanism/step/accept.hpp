// Before and after Newton's iteration of a step: the projection's factors, the local error, what an accepted state
// keeps, and doubts about the rows that were solved for.
#pragma once

#include "mechanism/step/newton.hpp"

namespace tisserand::mechanism {

/// What an accepted state keeps of its evaluation: unit quaternions, frames, unwrapped angles and scales of forces.
void settle(const Model& model, const Evaluation& now, State& state);

/// What a step takes from the state where it begins: the deformation of damped bodies, and factors of the position
/// projection, if it has one. False, with the outcome: singular.
bool begin(const Model& model, const StepScheme& scheme, const State& state, Workspace& workspace, StepReport& report);

/// The solution of a step becomes the state and is learnt from, unless its error is too large: `inaccurate`, and the
/// state as before.
void finish(Iteration& it);

/// Whether the rank of the constraints may have changed in the step: rows that are left out are open, or an
/// overconstrained or singular step failed.
bool rows_are_doubtful(const Model& model, const StepReport& report, const State& state, const Evaluation& evaluation);

/// Before a step: other constraint rows to solve for, where those of the state come near to being dependent (RowWatch).
/// Returns whether they changed.
bool renew_rows(const Model& model, State& state, Workspace& workspace);

/// After a doubtful step: back to where it began, with other rows to solve for. Those that are independent there, for
/// the old ones may have become dependent on the way and the end of the step satisfies nothing; if that says no more
/// than was known (the step left a position of lower rank), those that are independent where it ended. False, and the
/// state as it was, if they stay.
bool choose_rows_again(const Model& model, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

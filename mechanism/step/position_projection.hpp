// Closing of positions in stabilised index 2: the smallest change, weighted with mass and stiffness of the bodies, that
// meets the constraints.
#pragma once

#include "mechanism/equations/workspace.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Readies [W Bᵀ; B 0] for a step from `state`, W = c_m M + c_k K of the bodies alone: made anew, at `state`, where
/// bodies have turned too far or too many steps have passed since the last one, or the step is more than twice or less
/// than half of what it was then. What decides are motions of bodies with mass and numbers of steps, no numbers of
/// iterations.
[[nodiscard]] FactorReport prepare_closing(const Model& model, const State& state,
                                           const TangentCoefficients& coefficients, double step, Workspace& workspace);

/// The correction d with W d + Bᵀ μ = 0 for W and Bᵀ of prepare_closing(), and B d = workspace.bias, about: for B of
/// then, or, where bodies have turned much since, of the last evaluate(). Internal coordinates of superelements stay.
/// All corrections of a step lie in the range of one W⁻¹Bᵀ: their sum follows from what they close, whatever the
/// iterations on the way. Nodes without mass have no weight, so that those of virtual bodies, kept or eliminated,
/// change nothing.
void close_positions(const Model& model, Workspace& workspace);

/// Notes what an accepted step uses up.
void age_closing(const Model& model, Workspace& workspace);

}  // namespace tisserand::mechanism

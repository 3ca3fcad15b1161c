// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of a scene whose degrees of freedom are all driven: the constraints alone give positions, velocities,
// accelerations and reactions.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/analyses/start.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Name of the joint coordinate that moves most in a motion ξ of a linearisation, or of the node that moves most.
std::string name_of_direction(const Model& model, const State& state, const Eigen::VectorXd& xi,
                              Evaluation& evaluation);

/// Throws Error if the drives do not determine the motion. The message names what is free: flexible bodies, or joint
/// coordinates without a drive.
void require_determined(const Model& model, const Mobility& mobility, const std::string& where, const State& state,
                        Workspace& workspace);

/// Moves the state of a fully driven mechanism to the end of the step. Newton's iteration solves Φ(q, t) = 0 from q ∘
/// exp(h v + h²/2 v̇), where h is the step. Then B v = −Φ_t and B v̇ = −(Ḃ v + Φ_tt) give v and v̇, THEORY (59). Where
/// the rank of the constraints changes, the active rows are determined again. If the outcome is not `accepted`, the
/// state does not change.
[[nodiscard]] StepReport move_along(const Model& model, const formats::IntegratorSpec& options, const StepEnd& end,
                                    State& state, Workspace& workspace);

/// Solves the constraints for v and v̇ at the positions of the state, THEORY (59). Returns false if the constraints do
/// not determine v and v̇.
[[nodiscard]] bool solve_rates(const Model& model, State& state, Workspace& workspace);

/// Solves Bᵀλ = −(G_iner + G_int − F), THEORY (58), for the multipliers λ of drives and reactions at the state's
/// motion. Redundant rows get 0. Returns false if the constraints do not determine the motion.
[[nodiscard]] bool solve_multipliers(const Model& model, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

// Motion of a scene whose every degree of freedom is driven: positions, velocities, accelerations and reactions from
// the constraints alone.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/analyses/start.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// The joint coordinate that moves most in a motion ξ of a linearisation, or the node.
std::string name_of_direction(const Model& model, const State& state, const Eigen::VectorXd& xi,
                              Evaluation& evaluation);

/// Throws Error that names what is free: flexible bodies, whose deformation no drive prescribes, or joint coordinates
/// that nothing drives.
void require_determined(const Model& model, const Mobility& mobility, const std::string& where, const State& state,
                        Workspace& workspace);

/// Moves the state to the end of the step: Φ(q, t) = 0 by Newton's iteration from q ∘ exp(h v + h²/2 v̇), then
/// B v = −Φ_t and B v̇ = −(Ḃ v + Φ_tt). Where the rank of the constraints changes, the active rows are found anew. On
/// any outcome but `accepted` the state is as before.
[[nodiscard]] StepReport move_along(const Model& model, const formats::IntegratorSpec& options, const StepEnd& end,
                                    State& state, Workspace& workspace);

/// v and v̇ that the constraints demand at the positions of the state. False if they do not determine them.
[[nodiscard]] bool solve_rates(const Model& model, State& state, Workspace& workspace);

/// λ of Bᵀλ = −(G_iner + G_int − F) for the state's motion: forces of drives and reactions; redundant rows 0. False if
/// the constraints do not determine the motion.
[[nodiscard]] bool solve_multipliers(const Model& model, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

// Relative equilibrium: the scene at rest in axes that turn steadily.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// The joint coordinate, or the node, that moves most where the scene as a whole turns about the axis of the rotation,
/// or empty: joints, drives or springs hold it. Away from equilibrium the stiffness does not show that nothing holds
/// this turn.
std::string free_turn_name(const Model& model, const formats::RotationSpec& rotation, State state,
                           Evaluation& evaluation);

/// The joint coordinate, or the node, that moves most in a motion of the steadily turning state that nothing holds, or
/// empty.
std::string free_motion_name(const Model& model, const formats::RotationSpec& rotation, State state,
                             Evaluation& evaluation);

/// What does not turn with the scene, or empty: a joint or drive that forbids the velocities of the turn, or forces on
/// a node that are others once the scene has turned by a radian (gravity across the axis, loads, springs and bushings
/// of the ground). There is no steady state then.
std::string what_does_not_turn(const Model& model, const formats::RotationSpec& rotation, State state,
                               Evaluation& evaluation);

/// Equilibrium of loads, gravity and the inertia of the steady rotation of the options under the present load factor,
/// with whose root the rate grows; by Newton's iteration with the stiffness of `linearise` (dense, with the softening
/// of the rotation). The state ends with the velocities and accelerations of the rotation.
[[nodiscard]] StepOutcome balance_turning(EquilibriumSearch& search);

}  // namespace tisserand::mechanism

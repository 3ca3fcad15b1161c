// SPDX-License-Identifier: GPL-3.0-or-later
// Relative equilibrium: the scene at rest in axes that rotate steadily.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Name of the joint coordinate or node that moves most when the whole scene turns about the rotation axis. Empty if
/// joints, drives or springs prevent this turn. The stiffness is taken at rest, since away from equilibrium it does not
/// reveal that the turn is free.
std::string free_turn_name(const Model& model, const formats::RotationSpec& rotation, State state,
                           Evaluation& evaluation);

/// Name of the joint coordinate or node that moves most in a free motion of the steadily turning state. Empty if there
/// is none.
std::string free_motion_name(const Model& model, const formats::RotationSpec& rotation, State state,
                             Evaluation& evaluation);

/// Name of what prevents a steady rotation; empty if nothing prevents it. It is a joint or drive that forbids the
/// velocities of the turn, or forces on a node that change when the scene turns by a radian. Examples are gravity
/// across the axis, loads, springs and bushings to the ground.
std::string what_does_not_turn(const Model& model, const formats::RotationSpec& rotation, State state,
                               Evaluation& evaluation);

/// Finds the equilibrium of loads, gravity and the inertia of the steady rotation under the present load factor. The
/// angular velocity grows with the root of this factor. Newton's iteration uses the dense stiffness of linearise(),
/// which contains the softening by the rotation. The final state has the velocities and accelerations of the rotation.
[[nodiscard]] StepOutcome balance_turning(EquilibriumSearch& search);

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Interface between integration and mechanics: evaluates a model at a state in three stages. tangent.hpp has the
// derivatives.
#pragma once

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Computes positions, velocities and accelerations of all nodes and modes.
void evaluate_motion(const Model& model, const State& state, Evaluation& evaluation);

/// Calls evaluate_motion(), then computes Φ, B, B v + Φ_t of joints, couplings and motions: for assembly, kinematics.
void evaluate_constraints(const Model& model, const State& state, Evaluation& evaluation);

/// Calls evaluate_constraints(), then computes r of THEORY (58), G_iner + G_int + G_damp + Bᵀλ − F, the force scales
/// and the powers of loads and dampers. r has boundary coordinates; internal ones stay in the superelements' scratch.
/// Displacements since the start of a step are zero.
void evaluate(const Model& model, const State& state, Evaluation& evaluation);

/// Calls evaluate() for the state that evaluation.displacement reaches from the start of the step.
void evaluate_in_step(const Model& model, const State& state, Evaluation& evaluation);

/// Computes the motion of inactive nodes of modal bodies, at the state of the last evaluate(): for output.
void update_modal_nodes(const Model& model, Evaluation& evaluation);

/// Evaluates all joint coordinates, also unused ones, at the state of the last evaluate(): for output. Needs
/// update_modal_nodes().
void evaluate_coordinates(const Model& model, const State& state, Evaluation& evaluation);

/// Computes the wrench that each tie transmits to its follower. The massless bodies on it are in equilibrium, so it is
/// minus the sum of the wrenches of joints, couplings, springs and loads on them. Uses the state of the last evaluate()
/// and the multipliers `lambda`.
void evaluate_ties(const Model& model, const State& state, const double* lambda, Evaluation& evaluation);

/// Reaction of tie i, like that of a joint. Needs evaluate_ties().
JointReaction tie_reaction(const Model& model, std::size_t i, const Evaluation& evaluation);

/// Computes Ḃ v + Φ_tt of THEORY (59) (Φ̈ = B v̇ + Ḃ v + Φ_tt) for the state of the last evaluate().
void evaluate_bias(const Model& model, Evaluation& evaluation);

/// Copies r of all velocity coordinates: nodes and modal bodies, then internal coordinates of superelements. Uses the
/// state of the last evaluate().
void gather_residual(const Model& model, const Evaluation& evaluation, Eigen::Ref<Eigen::VectorXd> r);

/// Energies of all bodies and springs at the state of the last evaluate().
Energy evaluate_energy(const Model& model, const Evaluation& evaluation);

/// Power that dampers, friction and tyres dissipate, at the state of the last evaluate().
double damping_power(const Model& model, const Evaluation& evaluation);

/// Power that drives supply with the multipliers `lambda`, at the state of the last evaluate(). Evaluation::load_power
/// contains it for the multipliers of the state.
double drive_power(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& lambda, const Evaluation& evaluation);

/// Moves each stored angle by less than half a turn to its value at the last evaluate().
void unwrap_hinges(const Model& model, const Evaluation& evaluation, State& state);

}  // namespace tisserand::mechanism

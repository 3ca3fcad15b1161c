// SPDX-License-Identifier: GPL-3.0-or-later
// Interface between integration and mechanics: evaluates a model at a state in three stages. tangent.hpp has the
// derivatives.
#pragma once

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Computes the stage `motion`: positions, velocities and accelerations of all nodes and modes.
void evaluate_motion(const Model& model, const State& state, Evaluation& evaluation);

/// Computes the stages `motion` and `constraints`: Φ, B and B v + Φ_t of joints, couplings and drives. Assembly and
/// kinematics need no more.
void evaluate_constraints(const Model& model, const State& state, Evaluation& evaluation);

/// Computes all stages: constraints, then r of THEORY (58), G_iner + G_int + G_damp + Bᵀλ − F, the force scales and the
/// powers of loads and dampers. `residual` has boundary coordinates; rows of internal coordinates stay in the scratch
/// of the superelements. Displacements since the start of the step are set to zero.
void evaluate(const Model& model, const State& state, Evaluation& evaluation);

/// Computes all stages like evaluate(), but keeps evaluation.displacement. The caller must have set it to the
/// displacement of `state` from the start of the step.
void evaluate_in_step(const Model& model, const State& state, Evaluation& evaluation);

/// Computes the motion of inactive nodes of modal bodies, at the state of the last evaluate(). It is for output.
void update_modal_nodes(const Model& model, Evaluation& evaluation);

/// Computes all joint coordinates, also those that no force uses, at the state of the last evaluate(). It is for
/// output. Requires update_modal_nodes().
void evaluate_coordinates(const Model& model, const State& state, Evaluation& evaluation);

/// Computes the wrench that each tie transmits to its follower, evaluation.tie_wrenches. The massless bodies that hang
/// on the tie are in equilibrium. So the wrench is minus the sum of the wrenches of joints, couplings, springs,
/// friction and loads on these bodies. Uses the state of the last evaluate() and the multipliers `lambda`.
void evaluate_ties(const Model& model, const State& state, const double* lambda, Evaluation& evaluation);

/// Reaction of tie i, in the form of a reaction of a joint. Requires evaluate_ties().
JointReaction tie_reaction(const Model& model, std::size_t i, const Evaluation& evaluation);

/// Computes evaluation.bias, the part Ḃ v + Φ_tt of Φ̈ = B v̇ + Ḃ v + Φ_tt, THEORY (59), at the state of the last
/// evaluate().
void evaluate_bias(const Model& model, Evaluation& evaluation);

/// Copies the residual of all velocity coordinates to `r`: nodes and modal bodies, then internal coordinates of
/// superelements. Uses the state of the last evaluate().
void gather_residual(const Model& model, const Evaluation& evaluation, Eigen::Ref<Eigen::VectorXd> r);

/// Energies of all bodies and springs at the state of the last evaluate().
Energy evaluate_energy(const Model& model, const Evaluation& evaluation);

/// Power that dampers, friction and tyres dissipate, at the state of the last evaluate().
double damping_power(const Model& model, const Evaluation& evaluation);

/// Power that drives supply with the multipliers `lambda`, at the state of the last evaluate(). Evaluation::load_power
/// contains this power for the multipliers of the state.
double drive_power(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& lambda, const Evaluation& evaluation);

/// Unwraps the stored angles of joint coordinates: moves each by less than half a turn to its value at the last
/// evaluate().
void unwrap_hinges(const Model& model, const Evaluation& evaluation, State& state);

}  // namespace tisserand::mechanism

// The interface between integration and mechanics: evaluates a model at a state in three stages. tangent.hpp has the
// derivatives.
#pragma once

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Positions, velocities and accelerations of all nodes and modes.
void evaluate_motion(const Model& model, const State& state, Evaluation& evaluation);

/// evaluate_motion(), then Φ, B, B v + Φ_t of all joints, couplings and motions: enough for assembly and kinematics.
void evaluate_constraints(const Model& model, const State& state, Evaluation& evaluation);

/// evaluate_constraints(), then r of THEORY (58), G_iner + G_int + G_damp + Bᵀλ − F, the force scales and the powers of
/// loads and dampers. r has boundary coordinates; internal ones stay in the superelements' scratch. Displacements since
/// the start of a step are zero.
void evaluate(const Model& model, const State& state, Evaluation& evaluation);

/// evaluate() for a state that evaluation.displacement leads to from the start of the step.
void evaluate_in_step(const Model& model, const State& state, Evaluation& evaluation);

/// The motion of the nodes of modal bodies that nothing acts on, at the state of the last evaluate(): for output.
void update_modal_nodes(const Model& model, Evaluation& evaluation);

/// All joint coordinates, also those that nothing uses, at the state of the last evaluate(): for output.
/// Needs update_modal_nodes().
void evaluate_coordinates(const Model& model, const State& state, Evaluation& evaluation);

/// Wrench that each tie transmits to its follower, from the equilibrium of the massless bodies on it: minus the sum of
/// the wrenches of joints, couplings, springs and loads on them. At the state of the last evaluate(), with the
/// multipliers `lambda`.
void evaluate_ties(const Model& model, const State& state, const double* lambda, Evaluation& evaluation);

/// Reaction of tie i, as of a joint, after evaluate_ties().
JointReaction tie_reaction(const Model& model, std::size_t i, const Evaluation& evaluation);

/// Fills Ḃ v + Φ_tt of THEORY (59) (Φ̈ = B v̇ + Ḃ v + Φ_tt) for the state of the last evaluate().
void evaluate_bias(const Model& model, Evaluation& evaluation);

/// r of all velocity coordinates: those of nodes and modal bodies, then the internal ones of superelements. At the
/// state of the last evaluate().
void gather_residual(const Model& model, const Evaluation& evaluation, Eigen::Ref<Eigen::VectorXd> r);

/// Energies of all bodies and springs, at the state of the last evaluate().
Energy evaluate_energy(const Model& model, const Evaluation& evaluation);

/// Power that dampers, friction and tyres dissipate. At the state of the last evaluate().
double damping_power(const Model& model, const Evaluation& evaluation);

/// Power that drives supply with the multipliers `lambda`. Evaluation::load_power has it with those of the state. At
/// the state of the last evaluate().
double drive_power(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& lambda, const Evaluation& evaluation);

/// Moves each stored angle by less than half a turn to that at the last evaluate().
void unwrap_hinges(const Model& model, const Evaluation& evaluation, State& state);

}  // namespace tisserand::mechanism

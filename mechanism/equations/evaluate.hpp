// The one door between integration and mechanics: residual, constraints and tangents of a model at a state.
#pragma once

#include "mechanism/equations/workspace.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Fills r = G_iner + G_int + G_damp + Bᵀλ − F (boundary coordinates; internal ones stay in the superelements'
/// scratch), Φ, B v + Φ_t, the force scales and the powers of loads and damping.
void evaluate(const Model& model, const State& state, Workspace& workspace);

/// The motion of the nodes of modal bodies that nothing acts on, at the state of the last evaluate(): for output.
void update_modal_nodes(const Model& model, Workspace& workspace);

/// All joint coordinates, also those that nothing uses, at the state of the last evaluate(): for output.
/// Needs update_modal_nodes().
void evaluate_coordinates(const Model& model, const State& state, Workspace& workspace);

/// Wrench that each tie transmits to its follower, from the equilibrium of the massless bodies that hang on it: minus
/// the sum of what joints, couplings, springs and loads exert on them. At the state of the last evaluate(), with the
/// multipliers `lambda`.
void evaluate_ties(const Model& model, const State& state, const double* lambda, Workspace& workspace);

/// Reaction of tie i, as of a joint, after evaluate_ties().
JointReaction tie_reaction(const Model& model, std::size_t i, const Workspace& workspace);

/// Fills Ḃ v + Φ_tt (Φ̈ = B v̇ + Ḃ v + Φ_tt) for the state of the last evaluate().
void evaluate_bias(const Model& model, Workspace& workspace);

/// What the constraint rows of the iteration matrix are derivatives of.
struct ConstraintRows {
  enum class Kind {
    plain,     ///< B: Φ for material increments
    position,  ///< B T(displacement of the step): Φ for increments of the rotation vector of the step
    velocity  ///< B + rate_factor ∂(B v)/∂q: rate_factor times B v for increments whose velocity is 1/rate_factor of
              ///< them
  };
  Kind kind = Kind::plain;
  double rate_factor = 0.0;
};

/// Fills the values of [A/s Bᵀ; rows 0] with A = c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q, internal coordinates condensed, at
/// the state of the last evaluate().
void evaluate_tangent(const Model& model, const State& state, const TangentCoefficients& coefficients, TangentKind kind,
                      const ConstraintRows& rows, Workspace& workspace);

/// Fills `values` of [W/s Bᵀ; B 0] with W = c_m M + c_k K of the bodies alone, at the state of the last evaluate();
/// superelements with their boundary coordinates.
void evaluate_weight(const Model& model, const State& state, const TangentCoefficients& coefficients,
                     Workspace& workspace, std::vector<double>& values);

/// At the state of the last evaluate().
Energy evaluate_energy(const Model& model, Workspace& workspace);

/// Moves each stored angle by less than half a turn to that at the last evaluate().
void unwrap_hinges(const Model& model, const Workspace& workspace, State& state);

}  // namespace tisserand::mechanism

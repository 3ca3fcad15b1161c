// SPDX-License-Identifier: GPL-3.0-or-later
// Generalised alpha on SO(3): parameters, prediction and correction of one step.
#pragma once

#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Parameters α_m, α_f, β, γ of a step, THEORY (62) to (64).
struct AlphaParameters {
  double alpha_m = 0.0, alpha_f = 0.0, beta = 0.25, gamma = 0.5;
};

/// Parameters of the method that the scene chooses, THEORY (65). Generalised alpha: α_m = (2ρ−1)/(ρ+1), α_f = ρ/(ρ+1).
/// HHT: α_m = 0, α_f = α. Both: γ = 1/2 + α_f − α_m, β = (γ+1/2)²/4.
AlphaParameters alpha_parameters(const formats::IntegratorSpec& spec);

/// Coefficients c_m, c_c, c_k of the tangent of a step of the length `step`, THEORY (68).
TangentCoefficients step_coefficients(const AlphaParameters& alpha, double step);

/// Rebuilds the algorithmic acceleration a_n of `state` for the new length `step`, THEORY (66): a_n ←
/// v̇_n + (h_new/h_old) (a_n − v̇_n). a_n is v̇ at t_n + (α_m − α_f) h.
void rebuild_algorithmic_acceleration(double step, State& state);

/// Data of one step that stay constant during its iterations.
struct StepScheme {
  AlphaParameters alpha;
  double step = 0.0;       ///< length h of the step
  TangentRequest request;  ///< request for the iteration matrix: THEORY (68) to (70)
  bool projects = false;   ///< whether a correction δ projects the positions, THEORY (67)
};

/// Scheme of a step from the state to the instant `end`. A length equal to the previous one up to round-off is set to
/// the previous one.
StepScheme step_scheme(const Model& model, const formats::IntegratorSpec& options, const State& state, double end);

/// Predicts a step by THEORY (62) to (64) with a_{n+1} = a_n: velocities, v̇ and the displacement of the evaluation.
/// The caller must update positions with retract().
void predict(const StepScheme& scheme, State& state, Evaluation& evaluation);

/// Changes the algorithmic acceleration a_{n+1} by `change`, and v, v̇ and the displacement by THEORY (62) to (64). The
/// caller must update positions with retract().
void add_acceleration(const StepScheme& scheme, const Eigen::VectorXd& change, State& state, Evaluation& evaluation);

/// Adds a solution of the iteration matrix, THEORY (68): the increment h² β Δa to acceleration, velocity and
/// displacement, and the multipliers. The correction δ is added to the displacement alone. The caller must update
/// positions with retract().
void correct(const StepScheme& scheme, const IterationMatrix& matrix, State& state, Evaluation& evaluation);

}  // namespace tisserand::mechanism

// The family of generalised alpha on SO(3): parameters, prediction and correction of one step.
#pragma once

#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Parameters of THEORY (62) to (64).
struct AlphaParameters {
  double alpha_m = 0.0, alpha_f = 0.0, beta = 0.25, gamma = 0.5;
};

/// THEORY (65). Generalised alpha: α_m = (2ρ−1)/(ρ+1), α_f = ρ/(ρ+1); HHT: α_m = 0, α_f = α; γ = 1/2 + α_f − α_m, β =
/// (γ+1/2)²/4.
AlphaParameters alpha_parameters(const formats::IntegratorSpec& spec);

/// c_m, c_c, c_k of THEORY (68).
TangentCoefficients step_coefficients(const AlphaParameters& alpha, double step);

/// a_n for a new step size, THEORY (66): a = v̇ + (h_new/h_old) (a − v̇), since a_n stands for v̇ at t_n + (α_m − α_f) h.
void rebuild_algorithmic_acceleration(double step, State& state);

/// What stays the same during one step.
struct StepScheme {
  AlphaParameters alpha;
  double step = 0.0;       ///< h
  TangentRequest request;  ///< of the iteration matrix: THEORY (68) to (70)
  bool projects = false;   ///< positions are projected by a correction δ of their own: THEORY (67)
};

/// For a step from a time to another; one that is as long as the step before but for round-off is that one.
StepScheme step_scheme(const Model& model, const formats::IntegratorSpec& options, const State& state, double end);

/// THEORY (62) to (64) with a_{n+1} = a_n: velocities, v̇ and the displacement of the evaluation; positions follow
/// with retract().
void predict(const StepScheme& scheme, State& state, Evaluation& evaluation);

/// Changes a_{n+1} by `change`, and v, v̇ and the displacement by THEORY (62) to (64); positions follow with retract().
void add_acceleration(const StepScheme& scheme, const Eigen::VectorXd& change, State& state, Evaluation& evaluation);

/// Adds the increment h² β Δa of the matrix to acceleration, velocity and displacement, its multipliers, and its
/// correction δ to the displacement alone: THEORY (68); positions follow with retract().
void correct(const StepScheme& scheme, const IterationMatrix& matrix, State& state, Evaluation& evaluation);

}  // namespace tisserand::mechanism

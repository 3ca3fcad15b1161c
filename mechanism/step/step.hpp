// Time step of the constrained equations on SO(3): generalised alpha and HHT, index 3 and stabilised index 2.
//
// [BCA12] Bruls, Cardona, Arnold 2012 (Lie group generalised alpha), [ABC15] Arnold, Bruls, Cardona 2015 (start values,
// stabilised index 2), [GGL85] Gear, Gupta, Leimkuhler 1985.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/equations/workspace.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// (1−α_m) a_{n+1} + α_m a_n = (1−α_f) v̇_{n+1} + α_f v̇_n;  v_{n+1} = v_n + h ((1−γ) a_n + γ a_{n+1});
/// q_{n+1} = q_n ∘ exp(h v_n + h² ((1/2−β) a_n + β a_{n+1}) + δ), δ = 0 for index 3.
struct AlphaParameters {
  double alpha_m = 0.0, alpha_f = 0.0, beta = 0.25, gamma = 0.5;
};

/// Generalised alpha: α_m = (2ρ−1)/(ρ+1), α_f = ρ/(ρ+1); HHT: α_m = 0, α_f = α; γ = 1/2 + α_f − α_m, β = (γ+1/2)²/4.
AlphaParameters alpha_parameters(const formats::IntegratorSpec& spec);

/// c_m, c_c, c_k for an increment of h² β a_{n+1}.
TangentCoefficients step_coefficients(const AlphaParameters& alpha, double step);

enum class StepOutcome { accepted, singular, diverged, too_many_iterations, inaccurate };

/// What one step did. Ratios are measured values divided by their tolerance: at most 1 when accepted.
struct StepReport {
  StepOutcome outcome = StepOutcome::accepted;
  int iterations = 0;
  int factorisations = 0;
  double force_ratio = 0.0;
  double constraint_ratio = 0.0;
  double error_ratio = 0.0;   ///< estimated local error, where the step is controlled
  double residual = 0.0;      ///< largest |r| of force rows, of moment rows / length
  double constraint = 0.0;    ///< largest |Φ| (positions, and angles times length)
  int worst_coordinate = -1;  ///< of the largest residual, when not accepted
  int worst_constraint = -1;  ///< of the largest violation, when not accepted and larger in ratio
  int singular_column = -1;
  int row_choices = 0;  ///< how often the constraint rows that are solved for were chosen anew
};

/// Where a step ends, and the instant at which loads are evaluated there (just before a jump).
struct StepEnd {
  double time = 0.0;
  double load_time = 0.0;
};

/// One step from `state` (accepted, consistent) to `end`. On any outcome but `accepted` the state is as before.
/// Where the rank of the constraints has changed on the way (rows that are left out open, or the step fails in an
/// overconstrained mechanism) the rows are chosen anew and the step is taken again. No heap allocation but there.
[[nodiscard]] StepReport advance(const Model& model, const formats::IntegratorSpec& options, const StepEnd& end,
                                 State& state, Workspace& workspace);

/// a_n for a new step size: a = v̇ + (h_new/h_old) (a − v̇), since a_n stands for v̇ at t_n + (α_m − α_f) h.
void rebuild_algorithmic_acceleration(double step, State& state);

/// "body/node, translation x; likely cause ..." for a step that was not accepted.
std::string explain(const Model& model, const StepReport& report);

}  // namespace tisserand::mechanism

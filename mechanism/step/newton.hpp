// The operations of a Newton iteration of a step, which step.cpp calls.
#pragma once

#include "mechanism/step/convergence.hpp"
#include "mechanism/step/step_report.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// kept: those that are there, of earlier steps; fresh: made in this step, again in every iteration that does not
/// converge quickly.
enum class Factors { kept, fresh };

/// What the iterations of one step have in common, and how they go.
struct Iteration {
  const Model& model;
  const formats::IntegratorSpec& options;
  const StepScheme& scheme;
  State& state;
  Workspace& workspace;
  StepReport& report;
  Factors factors;

  int count = 0;  ///< increments so far
  /// Sizes of the last two increments, infinite where there was none.
  double increment = std::numeric_limits<double>::infinity();
  double last_increment = std::numeric_limits<double>::infinity();
  double last_residual = 0.0, last_constraint_ratio = 0.0;  ///< where factors were looked at
};

/// Readies the last accepted state for a step of another size: the algorithmic acceleration is rebuilt, and with index
/// 3 the violation B v + Φ_t of the velocities, −C h² B v̈ in the settled motion of one step size, is brought to that of
/// the new one. Left as it was, it would throw the multipliers off by O(h) for many steps ("Index 3 and a change of
/// step" in DECISIONS.md). Positions stay, and velocities change by M⁻¹Bᵀ μ only. False: singular.
bool change_step(Iteration& it);

/// Norms of the last evaluation, in the report too; true if they, or the last increments, are small enough. Sets the
/// outcome when the iteration cannot go on.
bool converged(Iteration& it);

/// Sees to it that the factors serve the next increment: refactors at the present state where that is due. False where
/// kept factors contract too slowly, which is no outcome, or the matrix is singular, which is one.
bool ready_factors(Iteration& it);

/// increment, multipliers and correction of the matrix for the residual and the violations of the last evaluation:
/// THEORY (69), then (67).
void solve(Iteration& it);

}  // namespace tisserand::mechanism

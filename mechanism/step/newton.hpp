// SPDX-License-Identifier: GPL-3.0-or-later
// Operations of Newton's iteration of a step, which step.cpp calls.
#pragma once

#include "mechanism/step/convergence.hpp"
#include "mechanism/step/step_report.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Data that all operations of the Newton iteration of one step use, and its progress.
struct Iteration {
  const Model& model;
  const formats::IntegratorSpec& options;
  const StepScheme& scheme;
  State& state;
  Workspace& workspace;
  StepReport& report;
  Factors factors;

  int count = 0;  ///< increments so far
  /// Size of the last increment, infinite if there was none.
  double increment = std::numeric_limits<double>::infinity();
  /// Size of the increment before the last one, infinite if there was none.
  double last_increment = std::numeric_limits<double>::infinity();
  /// Residual and constraint ratio at the last check of the factors, and the ratio at the check before it.
  double last_residual = std::numeric_limits<double>::infinity();
  double last_constraint_ratio = std::numeric_limits<double>::infinity();
  double earlier_constraint_ratio = std::numeric_limits<double>::infinity();
};

/// Prepares the last accepted state for another step size: rebuilds its algorithmic acceleration. With index 3 it also
/// scales the violation B v + Φ_t of the velocities, −C h² B v̈ in settled motion, to the new step size. An unscaled
/// violation would disturb the multipliers by O(h) for many steps ("Index 3 and a change of step" in DECISIONS.md).
/// Positions stay, and velocities change by A⁻¹Bᵀ μ only, A of THEORY (69). Returns false if the matrix is singular.
bool change_step(Iteration& it);

/// Whether the residual and the violations of the last evaluation are below their limits, or increments have reached
/// round-off. Stores the norms in the report. Sets the outcome if the iteration cannot continue.
bool converged(Iteration& it);

/// Provides factors for the next increment: factors again at the present state if necessary. Returns false if kept
/// factors contract too slowly (no outcome is set) or if the matrix is singular (the outcome is set).
bool ready_factors(Iteration& it);

/// Solves THEORY (69), then (67), for the residual and the violations of the last evaluation. The iteration matrix
/// receives increment, multipliers and correction.
void solve(Iteration& it);

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Static equilibrium of a scene: Newton's iteration with exact tangents and load steps.
#pragma once

#include <functional>
#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/analyses/stability.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Callback before every iteration; true ends the analysis.
using Interrupt = std::function<bool()>;

/// Limit of the reciprocal condition (after scaling) of a stiffness matrix. Below it a rigid motion is free.
inline constexpr double free_motion_condition = 1e-14;
struct StaticsReport {
  StepOutcome outcome = StepOutcome::accepted;
  int iterations = 0;
  int load_steps = 0;     ///< number of load steps, including halved ones
  double residual = 0.0;  ///< largest force, largest moment / length
  double constraint = 0.0;
  bool interrupted = false;
  Stability stability;         ///< stability of the final state
  double stable_until = 0.0;   ///< load factor of the last stable load step before the first unstable one
  double unstable_from = 2.0;  ///< load factor of the first unstable load step; above 1: none
  int descents = 0;            ///< iterations of the search for a stable equilibrium
  std::string explanation;     ///< for a failure: equation and likely cause
};

/// Arguments and report of a search for equilibrium.
struct EquilibriumSearch {
  const Model& model;
  const formats::StaticsSpec& options;
  const Interrupt& interrupted;
  State& state;
  Workspace& workspace;
  StaticsReport report = {};
};

/// Result of a search that starts from a state with a free motion. It ends where all loads and gravity hold the scene,
/// as a pendulum hangs.
struct Settled {
  std::string free;  ///< motion that is free even there; empty: an equilibrium was found
  int descents = 0;  ///< iterations of the search; 0: the first state was already held
};
Settled settle_under_load(const Model& model, const formats::StaticsSpec& options, const Interrupt& interrupted,
                          State& state, Workspace& workspace);

/// Finds the equilibrium under loads (at the state's time) and gravity, from `state` with all velocities zero. Load
/// steps are halved where the iteration fails. If the options have a steady rotation, its inertia forces count. If the
/// scene can move freely, the outcome is `singular` and names the direction.
[[nodiscard]] StaticsReport solve_statics(const Model& model, const formats::StaticsSpec& options,
                                          const Interrupt& interrupted, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

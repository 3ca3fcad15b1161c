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

/// Callback before every iteration. The analysis ends if it returns true.
using Interrupt = std::function<bool()>;

/// Limit of the reciprocal condition number of a scaled stiffness matrix. Below this limit a rigid motion is free.
inline constexpr double free_motion_condition = 1e-14;
/// Report of solve_statics().
struct StaticsReport {
  StepOutcome outcome = StepOutcome::accepted;
  int iterations = 0;
  int load_steps = 0;       ///< number of load steps, including halved ones
  double residual = 0.0;    ///< largest force, or largest moment / characteristic length
  double constraint = 0.0;  ///< largest violation of the constraints
  bool interrupted = false;
  Stability stability;         ///< stability of the final state
  double stable_until = 0.0;   ///< load factor of the last stable load step before the first unstable one
  double unstable_from = 2.0;  ///< load factor of the first unstable load step; above 1: none
  int descents = 0;            ///< iterations of the search for a stable equilibrium
  std::string explanation;     ///< explanation of a failure: equation and likely cause
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

/// Result of settle_under_load().
struct Settled {
  std::string free;  ///< name of a motion that is free even there; empty: an equilibrium was found
  int descents = 0;  ///< iterations of the search; 0: the loads hold the first state already
};
/// Searches the equilibrium of a state with a free motion, where all loads and gravity hold the scene as a pendulum
/// hangs. If there is one, the state moves there. Otherwise the state does not change.
Settled settle_under_load(const Model& model, const formats::StaticsSpec& options, const Interrupt& interrupted,
                          State& state, Workspace& workspace);

/// Finds the equilibrium under gravity and the loads at the state's time, from `state` with all velocities zero. Load
/// steps are halved where Newton's iteration fails. If the options have a steady rotation, its inertia forces count as
/// loads. If the scene can move freely, the outcome is `singular` and the explanation names the direction.
[[nodiscard]] StaticsReport solve_statics(const Model& model, const formats::StaticsSpec& options,
                                          const Interrupt& interrupted, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

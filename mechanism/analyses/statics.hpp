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

/// Polled before every iteration; true ends the analysis.
using Interrupt = std::function<bool()>;

/// A stiffness matrix with a smaller reciprocal condition (after scaling) leaves a rigid motion free.
inline constexpr double free_motion_condition = 1e-14;
struct StaticsReport {
  StepOutcome outcome = StepOutcome::accepted;
  int iterations = 0;
  int load_steps = 0;     ///< taken, after halvings
  double residual = 0.0;  ///< largest force, largest moment / length
  double constraint = 0.0;
  bool interrupted = false;
  Stability stability;         ///< of the end
  double stable_until = 0.0;   ///< load factor of the last stable load step before the first unstable one
  double unstable_from = 2.0;  ///< load factor of the first unstable load step; above 1: none
  int descents = 0;            ///< iterations of the search for a stable equilibrium
  std::string explanation;     ///< of a failure: equation and likely cause
};

/// A search for equilibrium: of what, how, and what came of it.
struct EquilibriumSearch {
  const Model& model;
  const formats::StaticsSpec& options;
  const Interrupt& interrupted;
  State& state;
  Workspace& workspace;
  StaticsReport report = {};
};

/// From a state that can move freely to the equilibrium in which the whole of loads and gravity holds it, as a pendulum
/// hangs.
struct Settled {
  std::string free;  ///< what nothing holds even there; empty: it was found
  int descents = 0;  ///< iterations of the search; 0: the state was held as it stood
};
Settled settle_under_load(const Model& model, const formats::StaticsSpec& options, const Interrupt& interrupted,
                          State& state, Workspace& workspace);

/// Equilibrium under loads (at the state's time) and gravity, from `state` with all velocities zero, in load steps that
/// are halved where the iteration fails; in the steady rotation of the options, if there is one. A scene that can move
/// freely is an outcome `singular` that names the direction.
[[nodiscard]] StaticsReport solve_statics(const Model& model, const formats::StaticsSpec& options,
                                          const Interrupt& interrupted, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

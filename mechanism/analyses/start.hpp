// SPDX-License-Identifier: GPL-3.0-or-later
// Start of an analysis: preflight, initial values, free velocities, projection, consistent accelerations.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/analyses/preflight.hpp"
#include "mechanism/analyses/start_velocities.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/equations/mobility.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Largest corrections by the projection of positions and velocities on the constraints. `position` is |Φ| before the
/// projection, relative to the characteristic length (angles in rad). `velocity` is |B v| before it, relative to the
/// largest velocity.
struct Projection {
  double position = 0.0;
  double velocity = 0.0;
};

/// Solves [M Bᵀ; B 0][v̇; λ] = [F − G; −Ḃ v] for accelerations v̇ and multipliers λ, THEORY (58), (59). A singular mass
/// matrix is regularised with `step`² times the stiffness, so that massless directions are in static equilibrium.
/// Returns whether it was regularised. Throws Error that names a direction without mass, stiffness and constraint.
bool solve_accelerations(const Model& model, double step, const std::string& where, State& state, Workspace& workspace);

/// Report of start(): mobility, checks, corrections and derived velocities.
struct StartReport {
  Mobility mobility;
  Preflight preflight;
  Projection projection;
  StartVelocities velocities;
  bool massless = false;  ///< whether a singular mass matrix was regularised
  double moved = 0.0;     ///< largest displacement of a node by initial values
};

/// Starts the analysis of the scene. Redundant constraint rows become inactive. Initial values move bodies rigidly
/// (only with StartFrom::poses). Velocities that the scene does not give are derived, except in statics. Then positions
/// and velocities are projected on the constraints. In dynamics consistent accelerations and multipliers follow, and
/// the energy balance counts from this state.
StartReport start(const formats::Scene& scene, StartFrom from, BuiltModel& built, Workspace& workspace);

/// Sets work and dissipation to zero at this state, and stores its energy as the initial energy. The energy balance
/// counts from here.
void begin(const Model& model, State& state, Workspace& workspace);

/// Solves for accelerations and multipliers again after a step that ended on a breakpoint, if loads or drives jump
/// there. Uses the loads after the jump.
void pass_breakpoint(const Model& model, const formats::Scene& scene, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

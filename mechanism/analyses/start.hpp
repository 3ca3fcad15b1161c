// Start of an analysis: pre-flight, initial values, free velocities, projection, consistent accelerations.
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

/// Largest corrections that the projection made: |Φ| before it relative to the characteristic length (angles as they
/// are), |B v| relative to the largest velocity.
struct Projection {
  double position = 0.0;
  double velocity = 0.0;
};

/// v̇ and λ from [M Bᵀ; B 0][v̇; λ] = [F − G; −Ḃ v]. A singular mass matrix is regularised with step² times the stiffness
/// (its massless directions are in static equilibrium then); returns whether it was. Throws Error that names a
/// direction without mass, stiffness and constraint.
bool solve_accelerations(const Model& model, double step, const std::string& where, State& state, Workspace& workspace);

struct StartReport {
  Mobility mobility;
  Preflight preflight;
  Projection projection;
  StartVelocities velocities;
  bool massless = false;  ///< the mass matrix was regularised
  double moved = 0.0;     ///< largest displacement of a node by initial values
};

/// The start of a scene, with rows that others imply made inactive, for the analysis of the scene: initial values move
/// the bodies rigidly, free velocities are derived (statics has none), then both are projected; dynamics: also the
/// consistent start and energies counted from here. Initial values move `poses` alone.
StartReport start(const formats::Scene& scene, StartFrom from, BuiltModel& built, Workspace& workspace);

/// Work, dissipation and energy start from zero here.
void begin(const Model& model, State& state, Workspace& workspace);

/// After a step that ended on a breakpoint: where loads jump, accelerations and multipliers are solved anew on its far
/// side.
void pass_breakpoint(const Model& model, const formats::Scene& scene, State& state, Workspace& workspace);

}  // namespace tisserand::mechanism

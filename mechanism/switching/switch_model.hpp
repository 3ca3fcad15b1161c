// From one model of a scene to another while it moves: a switch of effects.
#pragma once

#include <map>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "mechanism/build/build_model.hpp"
#include "mechanism/step/workspace.hpp"
#include "mechanism/switching/deformation.hpp"
#include "mechanism/switching/momentum.hpp"

namespace tisserand::mechanism {

/// A run where it stands.
struct Standing {
  const Model& model;
  const State& state;
};

/// Quasi-static deformations that bodies begin with, by their names; others begin undeformed.
using Deformations = std::map<std::string, Deformation>;

/// The model after a switch, ready for a step.
struct SwitchedModel {
  BuiltModel built;
  double energy = 0.0;  ///< after the switch less before
  double force = 0.0;   ///< largest jump of a reaction of a joint; 0 where the models have other constraints
};

/// `scene` with all switches carried out, from where `before` stands. Positions: StateTransfer, deformations, then onto
/// the constraints, rigidly as far as they let the bodies; bodies that deform keep their deformation and its rate while
/// they are moved. Velocities in the same way; then each group of jointed bodies with one that `changed` moves as one
/// rigid body until it has the linear and angular momentum of before, wherever its joints to ground leave it free.
/// Accelerations, multipliers and what a step needs are solved for; sums and running maxima go on. Nothing: the joints
/// cannot be closed, or nothing holds a direction.
std::optional<SwitchedModel> switch_model(const formats::Scene& scene, const BodyFiles& files, const Standing& before,
                                          const BodyGroup& changed, const Deformations& deformations);

}  // namespace tisserand::mechanism

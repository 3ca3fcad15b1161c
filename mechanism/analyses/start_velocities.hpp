// Velocities at the start: those that the scene gives are kept, the others follow from joints, drives and entries.
#pragma once

#include <string>
#include <vector>

#include "mechanism/build/build_model.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Where positions and velocities of a start come from.
enum class StartFrom {
  poses,  ///< the bodies of the scene: written velocities are given
  rest,   ///< another analysis that ended at rest: velocities are free but for those of `initial`
  motion  ///< another analysis: all velocities are given
};

/// What was done to the velocities.
struct StartVelocities {
  std::vector<std::string> derived;    ///< bodies with a velocity that follows from what others are given
  std::vector<std::string> deforming;  ///< of these, bodies that no rigid motion serves
  double kinetic_energy = 0.0;         ///< of the start; 0 where nothing was derived
  double deformation = 0.0;            ///< part of it in which bodies deform
};

/// Sets the velocities of bodies as written, absent ones zero, at the present positions.
void set_written_velocities(BuiltModel& built);

/// Finds the free velocities. Bodies move as rigid ones [v of a point; ω], w, and
///   ½ (w − w₀)ᵀ M (w − w₀) is the least that agrees with B v = −Φ_t and the rates that `initial` gives;
/// given components of w stay. w₀ has what the scene gives and zero elsewhere: for a body without any, that is its
/// kinetic energy. Where no w agrees, flexible bodies without a given velocity deform: v = R w + d with the least
/// dᵀ M d, internal coordinates included, and w is the nearest to w₀ of those that share it. Nothing changes where
/// the state agrees to round-off. Both are the limit of one proximal iteration on
///   [A 0 Bᵀ; 0 δM Jᵀ; B J −μ], J = B R,
/// which knows no dependent rows and no massless bodies as exceptions.
///
/// Throws Error, with the gap and the bodies and entries that it takes to close it, if given velocities, rates and
/// drives contradict each other by more than `tolerance` of the largest velocity.
StartVelocities derive_velocities(BuiltModel& built, StartFrom from, double tolerance, const std::string& where,
                                  Evaluation& evaluation);

/// Throws Error where an eliminated virtual body is given a velocity that its carrier does not give it.
void require_followers(const BuiltModel& built, double tolerance, const std::string& where, Evaluation& evaluation);

}  // namespace tisserand::mechanism

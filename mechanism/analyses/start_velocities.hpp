// SPDX-License-Identifier: GPL-3.0-or-later
// Velocities at the start: the given ones are kept, the others follow from joints, drives and entries of `initial`.
#pragma once

#include <string>
#include <vector>

#include "mechanism/build/build_model.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Source of positions and velocities at a start.
enum class StartFrom {
  poses,  ///< poses of the bodies in the scene; velocities written there are given
  rest,   ///< end of an analysis at rest; only velocities of `initial` are given
  motion  ///< end of another analysis; all velocities are given
};

/// Report of derive_velocities().
struct StartVelocities {
  std::vector<std::string> derived;    ///< names of bodies whose velocity follows from that of others
  std::vector<std::string> deforming;  ///< names of the bodies in `derived` that deform, because no rigid motion fits
  double kinetic_energy = 0.0;         ///< kinetic energy of the start; 0 if nothing was derived
  double deformation = 0.0;            ///< kinetic energy of the rates of deformation, a part of `kinetic_energy`
};

/// Sets the velocities of bodies at the present positions: those that the scene gives, and zero where it gives none.
void set_written_velocities(BuiltModel& built);

/// Derives the velocities that the scene does not give. Each part moves rigidly with w = [v of a point; ω]. The result
/// has the least ½ (w − w₀)ᵀ M (w − w₀) that satisfies B v = −Φ_t, THEORY (59), and the rates of `initial`. w₀ holds
/// the given velocities and zeros, so a body without given velocity contributes its kinetic energy. Given components of
/// w stay.
///
/// If no w satisfies the rows, flexible bodies without a given velocity deform: v = R w + d. Then dᵀ M d is least, with
/// internal coordinates, and w is the nearest to w₀ among the solutions. A state that satisfies the rows to round-off
/// does not change. The rigid and the deforming solution are the limit of one proximal iteration on
///   [A 0 Bᵀ; 0 δM Jᵀ; B J −μ], J = B R,
/// which needs no exceptions for dependent rows and massless bodies.
///
/// Throws Error if given velocities, rates and drives contradict each other by more than `tolerance` of the largest
/// velocity. The message names the gap, and the bodies and entries that conflict.
StartVelocities derive_velocities(BuiltModel& built, StartFrom from, double tolerance, const std::string& where,
                                  Evaluation& evaluation);

/// Throws Error if the scene gives an eliminated virtual body a velocity that differs from that of its carrier.
void require_followers(const BuiltModel& built, double tolerance, const std::string& where, Evaluation& evaluation);

}  // namespace tisserand::mechanism

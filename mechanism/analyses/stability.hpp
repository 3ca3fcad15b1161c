// SPDX-License-Identifier: GPL-3.0-or-later
// Stability of static equilibria: directions of negative stiffness on the constraints, and the search for an
// equilibrium without them.
#pragma once

#include <functional>
#include <string>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Counts of directions of ZᵀKZ. Z is the null space of the active constraint rows, K the exact stiffness with the
/// forces of the state. Without friction and follower forces an equilibrium is stable if and only if no direction is
/// negative (Lagrange, Dirichlet).
struct Stability {
  bool counted = false;   ///< false: more than `most_linearised` coordinates
  bool symmetric = true;  ///< whether the stiffness is symmetric; otherwise the count does not decide
  int unstable = 0;       ///< negative directions
  int neutral = 0;        ///< directions without stiffness
  std::string
      direction;  ///< joint coordinate or node that moves most in the most negative direction, else in a neutral one
};

/// Counts by the inertia of [K Bᵀ; B 0] (LDLᵀ of Bunch and Kaufman). The direction is named if `name` is true.
Stability stability_of(const Model& model, const State& state, Evaluation& evaluation, bool name);

/// Predicate that judges the last evaluation, or reports an interruption by the user.
using Balanced = std::function<bool()>;

struct DescentReport {
  bool found = false;  ///< an equilibrium without negative directions
  int iterations = 0;
  std::string direction;  ///< if none was found: what moved most, or what is free
};

/// Searches an equilibrium without negative directions. Each step moves along the eigenvectors of ZᵀKZ by −v·r/(|λ| +
/// μ), at most by a tenth of the scene's length or of a radian. It is Newton's step where the stiffness λ is positive,
/// and goes downhill in potential energy where λ is negative. From an unstable equilibrium it starts along the most
/// negative direction. `balanced` judges the last evaluation, whose load factor counts. Dense, up to 1000 coordinates.
/// If the search fails, it starts again with steps that are shortened where the forces along them change sign.
DescentReport descend(const Model& model, const Balanced& balanced, const Balanced& interrupted, State& state,
                      Evaluation& evaluation);

}  // namespace tisserand::mechanism

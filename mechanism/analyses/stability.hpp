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

/// Stability of a static equilibrium: numbers of negative and neutral directions of the stiffness ZᵀKZ. Z is the null
/// space of the active constraint rows, and K the exact stiffness with the forces of the state. Without friction and
/// follower forces an equilibrium is stable if and only if no direction is negative (Lagrange, Dirichlet).
struct Stability {
  bool counted = false;   ///< whether directions were counted; false above `most_linearised` coordinates
  bool symmetric = true;  ///< whether the stiffness is symmetric; otherwise the count does not decide
  int unstable = 0;       ///< number of directions with negative stiffness
  int neutral = 0;        ///< number of directions without stiffness
  /// Name of the joint coordinate or node that moves most in the most negative direction, else in a neutral one.
  std::string direction;
};

/// Counts negative and neutral directions by the inertia of [K Bᵀ; B 0] (LDLᵀ of Bunch and Kaufman). `name`: whether to
/// fill in Stability::direction.
Stability stability_of(const Model& model, const State& state, Evaluation& evaluation, bool name);

/// Predicate of descend(). As `balanced` it returns whether the last evaluation is in balance, as `interrupted` whether
/// the user has interrupted.
using Balanced = std::function<bool()>;

/// Result of descend().
struct DescentReport {
  bool found = false;  ///< an equilibrium without negative directions was found
  int iterations = 0;
  std::string direction;  ///< if none was found: name of what moved most, or of what is free
};

/// Searches an equilibrium without negative directions of the stiffness ZᵀKZ. Each step moves along the eigenvectors v
/// of ZᵀKZ by −v·r/(|λ| + μ), where r is the residual, λ the eigenvalue and μ ≥ 0 a damping. A step is at most a tenth
/// of the scene's length or of a radian. Where λ is positive it is Newton's step. Where λ is negative it reduces the
/// potential energy. From an unstable equilibrium the search starts along the most negative direction. `balanced`
/// judges the last evaluation, whose load factor counts. The matrices are dense, so at most 1000 coordinates are
/// accepted. If the search fails, it starts again with shorter steps where the forces along the eigenvectors change
/// sign.
DescentReport descend(const Model& model, const Balanced& balanced, const Balanced& interrupted, State& state,
                      Evaluation& evaluation);

}  // namespace tisserand::mechanism

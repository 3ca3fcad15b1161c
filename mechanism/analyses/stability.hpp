// Stability of static equilibria: the directions in which the stiffness on the constraints is negative, and the search
// for an equilibrium that has none.
#pragma once

#include <functional>
#include <string>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Directions of ZᵀKZ, Z the null space of the active constraint rows, K the exact stiffness with the forces of the
/// state. Without friction and follower forces an equilibrium is stable if and only if none is negative (Lagrange,
/// Dirichlet).
struct Stability {
  bool counted = false;   ///< false: more than `most_linearised` coordinates
  bool symmetric = true;  ///< of the stiffness; otherwise the count does not decide
  int unstable = 0;       ///< negative directions
  int neutral = 0;        ///< directions without stiffness
  std::string
      direction;  ///< joint coordinate or node that moves most in the most negative direction, else in a neutral one
};

/// Counts by the inertia of [K Bᵀ; B 0] (LDLᵀ of Bunch and Kaufman). The direction is named if `name` says so.
Stability stability_of(const Model& model, const State& state, Evaluation& evaluation, bool name);

/// A question about the last evaluation, or about the user.
using Balanced = std::function<bool()>;

struct DescentReport {
  bool found = false;  ///< an equilibrium without negative directions
  int iterations = 0;
  std::string direction;  ///< where it did not find one: what moved most, or what nothing holds
};

/// Goes to an equilibrium without negative directions. Each step moves along the eigenvectors of ZᵀKZ by −v·r/(|λ| +
/// μ), no further than a tenth of the scene's length or of a radian: Newton's step where the stiffness λ is positive,
/// downhill in potential energy where it is negative. From an unstable equilibrium it leaves along the most negative
/// direction. `balanced` judges the last evaluation. The load factor is that of the evaluation. Dense, up to 1000
/// coordinates. Where that does not end, it begins again with steps that become shorter where the forces along them
/// change sign.
DescentReport descend(const Model& model, const Balanced& balanced, const Balanced& interrupted, State& state,
                      Evaluation& evaluation);

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Counts of a model at a state: coordinates, constraints, the rank of their Jacobian, degrees of freedom.
#pragma once

#include <string>
#include <vector>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/connected_bodies.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Degrees of freedom of a mechanism, with the rank and the redundant rows of its constraints.
struct Mobility {
  int coordinates = 0;  ///< boundary and internal; those of tyre treads do not count
  int constraints = 0;
  int rank = 0;                ///< rank of the constraint Jacobian
  int degrees_of_freedom = 0;  ///< coordinates − rank
  int parts = 0;               ///< number of parts: bodies, each as a rigid one
  int freedoms = 6;            ///< degrees of freedom of one rigid body; in planar models 3
  int rigid_mobility = 0;      ///< degrees of freedom if every body were rigid: freedoms · parts − rank
  int gruebler() const { return freedoms * parts - constraints; }
  std::vector<int> redundant;  ///< constraint rows that depend on the other rows
  // Results of find_freedoms(), with every body as a rigid one:
  std::vector<std::string>
      /// Independent motions with held drives: joint coordinates, rotations in joints, whole bodies.
      free;
  std::vector<std::string> locked;  ///< joints of loops that cannot move although nothing drives them
};

/// Counts coordinates, constraints and degrees of freedom at a state. The rank of the constraint Jacobian B comes from
/// a rank-revealing QR, dense up to 150 rows and sparse above. Rotations are scaled by the characteristic length. The
/// rank of B on the motions of rigid parts gives the rigid mobility.
Mobility count_mobility(const Model& model, const State& state, Evaluation& evaluation);

/// Names the free motions and the locked joints in `mobility`, by the null space of B on the motions of rigid parts.
/// With more than 50 parts both lists are empty.
void find_freedoms(const Model& model, const State& state, Evaluation& evaluation, Mobility& mobility);

}  // namespace tisserand::mechanism

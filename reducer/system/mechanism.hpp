// SPDX-License-Identifier: GPL-3.0-or-later
// Messages about mechanisms inside a part: motions without stiffness.
#pragma once

#include <string>

#include <Eigen/Core>

#include "reducer/algebra/null_space.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/system/partition.hpp"

namespace tisserand::reducer {

/// Description of the motion `v` (n_I) of the interior coordinates of `part` while the boundary is at rest. If one
/// rigid motion fits all nodes that move, it says: "grid 3, grid 4 and 420 nodes more turn about the line through grid
/// 1 and grid 422". Otherwise it names the coordinates that move most.
std::string motion_words(const PartitionedPart& part, const Eigen::VectorXd& v);

/// Description of the motions of a null space, the first three in words.
std::string mechanism_words(const PartitionedPart& part, const NullSpace& null);

/// Words for the messages of require_stiffness(): what was held while motions without stiffness were searched for.
struct HeldState {
  std::string who;     ///< words for the held object: "the part"
  std::string how;     ///< words for what is held: "while its boundary is held"
  std::string remedy;  ///< what to do against a mechanism
};

/// Words for a search with the boundary of the part held.
HeldState boundary_held();

/// Throws Error if the stiffness has a null space or is indefinite; the message names the motions of the null space.
/// It also throws for a motion so soft that `factor` holds round-off in place of its stiffness. `state`: words for the
/// message.
void require_stiffness(const NullSpace& null, const Factor& factor, const PartitionedPart& part, const HeldState& state,
                       const std::string& where);

/// Warning that round-off is more than a thousandth of the stiffness of the softest motion; empty if it is not.
std::string softness_doubt(const NullSpace& null, const PartitionedPart& part);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Messages about mechanisms inside a part: motions without stiffness.
#pragma once

#include <string>

#include <Eigen/Core>

#include "reducer/algebra/null_space.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/system/partition.hpp"

namespace tisserand::reducer {

/// Description of the motion `v` (n_I) of the internal coordinates of `part` while the others are at rest. If one rigid
/// motion fits all nodes that move: "grid 3, grid 4 and 420 nodes more turn about the line through grid 1 and grid
/// 422". Otherwise it names the coordinates that move most.
std::string motion_words(const PartitionedPart& part, const Eigen::VectorXd& v);

/// Description of the motions of a null space, the first three in words.
std::string mechanism_words(const PartitionedPart& part, const NullSpace& null);

/// Words of the messages for the state in which motions without stiffness were searched for.
struct HeldState {
  std::string who;     ///< "the part"
  std::string how;     ///< "while its boundary is held"
  std::string remedy;  ///< remedy for a mechanism
};

/// Words for a part with its boundary held.
HeldState boundary_held();

/// Throws Error if the stiffness has a null space (the message names its motions) or is indefinite. Throws it also for
/// a motion so soft that `factor` holds round-off in place of its stiffness.
void require_stiffness(const NullSpace& null, const Factor& factor, const PartitionedPart& part, const HeldState& state,
                       const std::string& where);

/// Warning if round-off is more than a thousandth of the softest motion's stiffness, otherwise empty.
std::string softness_doubt(const NullSpace& null, const PartitionedPart& part);

}  // namespace tisserand::reducer

// Mechanisms inside a part: motions without stiffness, in words.
#pragma once

#include <string>

#include <Eigen/Core>

#include "reducer/algebra/null_space.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/system/partition.hpp"

namespace tisserand::reducer {

/// What moves when the internal coordinates of `part` move by `v` (n_I) and the others rest: "grid 3, grid 4 and 420
/// nodes more turn about the line through grid 1 and grid 422", where one rigid motion fits all nodes that move; else
/// the coordinates that move most.
std::string motion_words(const PartitionedPart& part, const Eigen::VectorXd& v);

/// All of a null space, the first three in words.
std::string mechanism_words(const PartitionedPart& part, const NullSpace& null);

/// What the messages call the state in which a motion was looked for.
struct HeldState {
  std::string who;     ///< "the part"
  std::string how;     ///< "while its boundary is held"
  std::string remedy;  ///< of a mechanism
};

/// Of the inside of a part.
HeldState boundary_held();

/// Throws Error if the stiffness has a null space (its motions named), is indefinite, or has a motion that is so soft
/// that `factor` holds round-off in place of its stiffness.
void require_stiffness(const NullSpace& null, const Factor& factor, const PartitionedPart& part, const HeldState& state,
                       const std::string& where);

/// A warning where round-off is more than a thousandth of the softest motion's stiffness; else empty.
std::string softness_doubt(const NullSpace& null, const PartitionedPart& part);

}  // namespace tisserand::reducer

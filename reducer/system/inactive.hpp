// Coordinates without stiffness and mass, such as the rotations of a truss's nodes: found and removed.
#pragma once

#include <string>

#include "reducer/system/system.hpp"

namespace tisserand::reducer {

/// Looks at the translations and the rotations of each node: a direction in which their block of S and M is below 1e-14
/// of the block's largest entry is without stiffness and mass as a whole, since S and M are positive semidefinite. One
/// coordinate per such direction is fixed to zero, and the rigid motions of the others of the block are turned so that
/// this changes no force. Throws Error if only coordinates of the boundary could be fixed.
void remove_inactive(const Mesh& mesh, const std::vector<int>& boundary, const std::string& where, int threads,
                     System& system);

}  // namespace tisserand::reducer

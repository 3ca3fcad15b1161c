// SPDX-License-Identifier: GPL-3.0-or-later
// Removal of coordinates without stiffness and mass, such as the rotations of a truss's nodes.
#pragma once

#include <string>

#include "reducer/system/system.hpp"

namespace tisserand::reducer {

/// Removes coordinates without stiffness and mass from `system`. It examines the block of S and M of the translations,
/// and of the rotations, of each node. Null directions of a block are those below 1e-14 of its largest entry. As S and
/// M are positive semidefinite, these have no stiffness and mass at all. One coordinate per direction is fixed to
/// zero. The rigid motions of the other coordinates of the block are adapted, which changes no force. Throws Error if
/// only coordinates of the boundary could be fixed.
void remove_inactive(const Mesh& mesh, const std::vector<int>& boundary, const std::string& where, int threads,
                     System& system);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Assembly of the sparse matrices S and M of all coordinates of the mesh, before ties are eliminated.
#pragma once

#include <functional>

#include "reducer/algebra/symmetric_pair.hpp"
#include "reducer/mesh/coordinates.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Assembles S and M of all coordinates of the mesh from the elements and the point masses. Memory is reserved
/// exactly, by the graph of the nodes. Every entry is summed in the order of the elements, so the result is equal for
/// any number of threads and ranks. With several ranks all followers must be in help_to_assemble(). `share` receives
/// the completed share of the elements, 0 to 1.
SymmetricPair assemble(
    const Mesh& mesh, const Coordinates& coordinates, int threads,
    const std::function<void(double)>& share = [](double /*done*/) {});

/// Does a follower's share of assemble(), with its own copy of the mesh. Throws Error if the leader's mesh differs.
/// `leaders_fingerprint`: number that identifies the leader's mesh.
void help_to_assemble(const Mesh& mesh, int leaders_fingerprint);

}  // namespace tisserand::reducer

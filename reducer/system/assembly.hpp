// From the mesh to the sparse matrices S and M of all its coordinates, ties not yet regarded.
#pragma once

#include <functional>

#include "reducer/algebra/symmetric_pair.hpp"
#include "reducer/mesh/coordinates.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Sum of the elements and of the nodal masses. Memory is reserved exactly from the graph of the nodes. Every entry is
/// summed in the order of the elements, so the result is the same for any number of threads and ranks.
/// By several ranks it needs that many followers in help_to_assemble(). `share` hears how much of the elements is
/// added.
SymmetricPair assemble(
    const Mesh& mesh, const Coordinates& coordinates, int threads,
    const std::function<void(double)>& share = [](double /*done*/) {});

/// What the followers do meanwhile, with their own copy of the mesh. Throws Error if the leader has another one.
void help_to_assemble(const Mesh& mesh, int leaders_fingerprint);

}  // namespace tisserand::reducer

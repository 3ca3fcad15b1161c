// Work of the processes that mpirun starts besides the first: they follow the calls of the leader.
#pragma once

#include <future>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Works until the leader ends. Needs a SolverSession. `made` is the mesh of the leader's part. All processes end if
/// the leader asks for its elements and it holds an error or differs from the leader's.
void follow_leader(std::future<Mesh> made);

}  // namespace tisserand::reducer

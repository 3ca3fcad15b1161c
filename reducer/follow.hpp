// The processes that mpirun starts beside the first: they do what the leader calls for.
#pragma once

#include <future>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Works until the leader ends. Needs a SolverSession. `made` is the mesh of the leader's part; if it holds an error, or
/// another mesh than the leader's, and the leader asks for its elements, all processes end.
void follow_leader(std::future<Mesh> made);

}  // namespace tisserand::reducer

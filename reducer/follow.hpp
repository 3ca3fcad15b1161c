// SPDX-License-Identifier: GPL-3.0-or-later
// Work of the processes that mpirun starts in addition to the first: they follow the calls of the leader.
#pragma once

#include <future>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Runs a follower process until the leader ends: it does the work that the leader calls for. Requires a
/// SolverSession. `made`: mesh of the leader's part. If it holds an error or differs from the leader's mesh, all
/// processes end when the leader needs its elements.
void follow_leader(std::future<Mesh> made);

}  // namespace tisserand::reducer

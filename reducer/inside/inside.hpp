// The inside of a part: from its matrices to boundary modes and internal modes, with what has no stiffness refused or
// kept.
#pragma once

#include <string>
#include <vector>

#include "reducer/modes/boundary_modes.hpp"
#include "reducer/modes/internal_modes.hpp"
#include "reducer/report/phase_listener.hpp"

namespace tisserand::reducer {

/// All that a reduction knows of the inside.
struct Inside {
  Partition partition;
  Blocks blocks;
  Factor S_II;  ///< of a part with a mechanism: of what its pins leave
  BoundaryModes boundary;
  InternalModes internal;
  std::vector<std::string> notes, warnings;  ///< whole sentences
};

/// Takes S and M apart, factors S_II, finds what has no stiffness, solves for the modes. `system` loses its matrices as
/// in take_apart(). Throws Error if something inside moves without stiffness and the part does not allow that.
Inside reduce_inside(const Mesh& mesh, System& system, const formats::Part& part, const PhaseListener& begin);

/// What consumers of the modes take.
InternalProblem problem_of(const Mesh& mesh, const System& system, const Inside& inside, const formats::Part& part,
                           const PhaseListener& begin);

}  // namespace tisserand::reducer

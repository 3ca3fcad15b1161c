// SPDX-License-Identifier: GPL-3.0-or-later
// Reduction of the inside of a part: boundary modes and internal modes from its matrices. Motions without stiffness are
// refused or kept.
#pragma once

#include <string>
#include <vector>

#include "reducer/modes/boundary_modes.hpp"
#include "reducer/modes/internal_modes.hpp"
#include "reducer/report/phase_listener.hpp"

namespace tisserand::reducer {

/// Partition, matrix blocks, factor and modes of the interior of a part: the data that a reduction needs.
struct Inside {
  Partition partition;
  Blocks blocks;
  Factor S_II;  ///< factor of S_II; for a mechanism, of the interior with its pins held
  BoundaryModes boundary;
  InternalModes internal;
  std::vector<std::string> notes, warnings;  ///< notes and warnings in whole sentences
};

/// Reduces the interior of a part: splits S and M, factors S_II, finds motions without stiffness and computes the
/// modes. `system` loses its matrices as in take_apart(). Throws Error if something in the interior moves without
/// stiffness and the part does not allow that.
Inside reduce_inside(const Mesh& mesh, System& system, const formats::Part& part, const PhaseListener& begin);

/// Collects the arguments of the functions that use the modes. The arguments must outlive the result.
InternalProblem problem_of(const Mesh& mesh, const System& system, const Inside& inside, const formats::Part& part,
                           const PhaseListener& begin);

}  // namespace tisserand::reducer

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

/// Data of the inside that a reduction needs.
struct Inside {
  Partition partition;
  Blocks blocks;
  Factor S_II;  ///< if the part has a mechanism, of the inside held by pins
  BoundaryModes boundary;
  InternalModes internal;
  std::vector<std::string> notes, warnings;  ///< whole sentences
};

/// Splits S and M, factors S_II, finds motions without stiffness and computes the modes. `system` loses its matrices as
/// in take_apart(). Throws Error if something inside moves without stiffness and the part does not allow that.
Inside reduce_inside(const Mesh& mesh, System& system, const formats::Part& part, const PhaseListener& begin);

/// Arguments for the functions that use the modes.
InternalProblem problem_of(const Mesh& mesh, const System& system, const Inside& inside, const formats::Part& part,
                           const PhaseListener& begin);

}  // namespace tisserand::reducer

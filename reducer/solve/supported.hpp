// SPDX-License-Identifier: GPL-3.0-or-later
// The part on its supports: its held coordinates, and the factor of the stiffness of the others.
#pragma once

#include <string>
#include <vector>

#include "reducer/algebra/factor.hpp"
#include "reducer/loads/supports.hpp"
#include "reducer/report/phase_listener.hpp"
#include "reducer/system/partition.hpp"

namespace tisserand::reducer {

/// Part with its held coordinates.
struct HeldPart {
  const Mesh& mesh;
  const System& system;
  const std::vector<OwnedCoordinate>& held;  ///< coordinates of the mesh with which the system was built
  const std::string& where;                  ///< for messages
};

struct Supported : HeldPart {
  explicit Supported(const HeldPart& part) : HeldPart(part) {}

  Partition partition;   ///< boundary: held coordinates q (boundary_node: their supports); internal: free ones
  Matrix S, M;           ///< for the free coordinates
  Factor factor;         ///< factor of S
  bool is_free = false;  ///< no supports: six coordinates are held, which leave no rigid motion and carry no force
};

/// Factors the stiffness of the supported part. Throws Error if supports leave a rigid motion (named), if something
/// inside moves without stiffness, or if the memory does not suffice for the factor and `modes` modes.
Supported support(const HeldPart& part, int modes, const PhaseListener& begin);

}  // namespace tisserand::reducer

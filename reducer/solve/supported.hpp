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

/// Mesh and system of a part with the coordinates that its supports hold.
struct HeldPart {
  const Mesh& mesh;
  const System& system;
  const std::vector<OwnedCoordinate>& held;  ///< coordinates of the mesh with which the system was built
  const std::string& where;                  ///< place of the part for messages
};

/// Part with its supports, whose stiffness matrix is factorised.
struct Supported : HeldPart {
  explicit Supported(const HeldPart& part) : HeldPart(part) {}

  /// Boundary: held coordinates q (boundary_node: index of the support); internal: free coordinates q.
  Partition partition;
  Matrix S, M;    ///< stiffness and mass of the free coordinates
  Factor factor;  ///< factor of S
  /// true: no supports; six coordinates are held, which leave no rigid motion and carry no force.
  bool is_free = false;
};

/// Factors the stiffness of the supported part. Throws Error if supports leave a rigid motion, which the message
/// names. It also throws if something in the part moves without stiffness, or if the memory does not suffice for the
/// factor and `modes` modes.
Supported support(const HeldPart& part, int modes, const PhaseListener& begin);

}  // namespace tisserand::reducer

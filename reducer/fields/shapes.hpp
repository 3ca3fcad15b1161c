// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of every node of the full mesh for every coordinate of the superelement.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// Motion of the whole mesh for every coordinate y of the superelement, x = T [1 0; Ψ Φ] y, computed by rows on
/// request. T resolves ties and leaves coordinates without stiffness at zero.
class FullShapes {
 public:
  /// Prepares the rows. The objects to which `part` refers must outlive this object.
  explicit FullShapes(const ReducedPart& part);

  Eigen::Index coordinates() const { return n_B_ + internal_.Phi.cols(); }
  /// Motion [translation; rotation] of the nodes for each coordinate, in part axes ((6 nodes) x coordinates). Missing
  /// rotations are zero.
  Eigen::MatrixXd motions(const std::vector<int>& nodes) const;

 private:
  const System& system_;
  const BoundaryModes& boundary_;
  const InternalModes& internal_;
  Eigen::Index n_B_;
  std::vector<int> place_;  ///< for each q: its boundary coordinate, or n_B + row of Ψ and Φ
};

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of every node of the full mesh for every coordinate of the superelement.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// x = T [1 0; Ψ Φ] y, computed by rows on request. T resolves ties and leaves coordinates without stiffness at zero.
class FullShapes {
 public:
  /// The objects to which `part` refers must outlive this one.
  explicit FullShapes(const ReducedPart& part);

  Eigen::Index coordinates() const { return n_B_ + internal_.Phi.cols(); }
  /// [translation; rotation] of each node in part axes: (6 nodes) x coordinates; zero for missing rotations.
  Eigen::MatrixXd motions(const std::vector<int>& nodes) const;

 private:
  const System& system_;
  const BoundaryModes& boundary_;
  const InternalModes& internal_;
  Eigen::Index n_B_;
  std::vector<int> place_;  ///< boundary coordinate of each q, or n_B + row of Ψ and Φ
};

}  // namespace tisserand::reducer

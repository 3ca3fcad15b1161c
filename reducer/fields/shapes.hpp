// The motion of every node of the full mesh for every coordinate of the superelement: from modes back to the mesh.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/modes/boundary_modes.hpp"
#include "reducer/modes/internal_modes.hpp"
#include "reducer/system/partition.hpp"
#include "reducer/system/system.hpp"

namespace tisserand::reducer {

/// x = T [1 0; Ψ Φ] y, row by row, as needed: T resolves ties and leaves coordinates without stiffness at zero.
class FullShapes {
 public:
  /// The arguments live as long as this.
  FullShapes(const System& system, const Partition& partition, const BoundaryModes& boundary,
             const InternalModes& internal);

  Eigen::Index coordinates() const { return n_B_ + internal_.Phi.cols(); }
  /// [translation; rotation] of each node in part axes: (6 nodes) x coordinates; zero rotations where it has none.
  Eigen::MatrixXd motions(const std::vector<int>& nodes) const;

 private:
  const System& system_;
  const BoundaryModes& boundary_;
  const InternalModes& internal_;
  Eigen::Index n_B_;
  std::vector<int> place_;  ///< of each q: boundary coordinate, or n_B + row of Ψ and Φ
};

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Partition into boundary coordinates (B), which other bodies see, and internal ones (I), which are condensed, and the
// blocks of S and M.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "reducer/system/system.hpp"

namespace tisserand::reducer {

/// Partition of the coordinates q of a system into boundary and interior. Boundary: in the order of the boundary
/// nodes, translations before rotations. Interior: ascending, with the coordinates that a boundary node does not
/// retain.
struct Partition {
  std::vector<int> boundary;
  /// Node of each boundary coordinate, as index in Mesh::boundary (or ::held, ::supports).
  std::vector<int> boundary_node;
  std::vector<int> boundary_component;  ///< component of each boundary coordinate, 0 to 5
  std::vector<int> internal;

  Eigen::Index n_B() const { return static_cast<Eigen::Index>(boundary.size()); }
  Eigen::Index n_I() const { return static_cast<Eigen::Index>(internal.size()); }
};

/// Mesh, system and partition of a part.
struct PartitionedPart {
  const Mesh& mesh;
  const System& system;
  const Partition& partition;
};

Partition partition(const Mesh& mesh, const System& system);

/// Makes a partition with the coordinates `boundary` in place of Mesh::boundary. Coordinates without stiffness and
/// mass are omitted.
Partition partition(const System& system, const std::vector<OwnedCoordinate>& boundary);

/// Six coordinates q whose rigid motions are as independent as possible: the pivots of R.
std::vector<int> six_coordinates(const System& system);

/// Blocks of S and M for boundary B and interior I. S_II and M_II are symmetric and sparse, S_IB and M_IB are sparse
/// (n_I x n_B), S_BB and M_BB are dense.
struct Blocks {
  Matrix S_II, M_II;
  Eigen::SparseMatrix<double> S_IB, M_IB;
  Eigen::MatrixXd S_BB, M_BB;
};

/// Blocks S_II and M_II of `matrices`, stored in its arrays.
SymmetricPair internal_matrices(SymmetricPair matrices, const Partition& p);

/// Blocks of `matrices` for the partition `p`. If `matrices` is moved in, its memory is reused, so that large blocks
/// are not held twice.
Blocks split(SymmetricPair matrices, const Partition& p);

/// Rows `which` of a matrix over all coordinates.
Eigen::MatrixXd rows(const Eigen::MatrixXd& all, const std::vector<int>& which);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Partition into boundary coordinates (B), which other bodies see, and internal ones (I), which are condensed, and the
// blocks of S and M.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "reducer/system/system.hpp"

namespace tisserand::reducer {

/// Numbers of the system's coordinates q. Boundary: in the order of the boundary nodes, translations before rotations.
/// Internal: ascending, including coordinates that a boundary node does not retain.
struct Partition {
  std::vector<int> boundary;
  std::vector<int> boundary_node;       ///< row of Mesh::boundary (::held, ::supports)
  std::vector<int> boundary_component;  ///< 0-5
  std::vector<int> internal;

  Eigen::Index n_B() const { return static_cast<Eigen::Index>(boundary.size()); }
  Eigen::Index n_I() const { return static_cast<Eigen::Index>(internal.size()); }
};

/// A part with its partitioned coordinates.
struct PartitionedPart {
  const Mesh& mesh;
  const System& system;
  const Partition& partition;
};

Partition partition(const Mesh& mesh, const System& system);

/// Partition with `boundary` in place of Mesh::boundary; coordinates without stiffness and mass are omitted.
Partition partition(const System& system, const std::vector<OwnedCoordinate>& boundary);

/// Six coordinates whose rigid motions are as independent as possible: the pivots of R.
std::vector<int> six_coordinates(const System& system);

/// Blocks S_II, M_II symmetric sparse; S_IB, M_IB (n_I x n_B); S_BB, M_BB.
struct Blocks {
  Matrix S_II, M_II;
  Eigen::SparseMatrix<double> S_IB, M_IB;
  Eigen::MatrixXd S_BB, M_BB;
};

/// S_II and M_II, in the arrays of `matrices`.
SymmetricPair internal_matrices(SymmetricPair matrices, const Partition& p);

/// Blocks of `matrices`, whose memory is reused if it is moved in, so that large blocks are not held twice.
Blocks split(SymmetricPair matrices, const Partition& p);

/// The rows `which` of a matrix over all coordinates.
Eigen::MatrixXd rows(const Eigen::MatrixXd& all, const std::vector<int>& which);

}  // namespace tisserand::reducer

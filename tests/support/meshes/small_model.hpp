// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh with supports and loads, small enough to be solved beside a test: element matrices -> displacements,
// frequencies.
#pragma once

#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Stiffness and mass of a mesh in part axes, six rows per node: 6 node + component (solids leave rotations empty).
struct SmallMatrices {
  Eigen::SparseMatrix<double> S;
  Eigen::SparseMatrix<double> M;
};

/// All elements and point masses of the mesh; spiders and tie equations are not for small models.
SmallMatrices assemble_small(const Mesh& mesh);

/// Supports and loads on the coordinates 6 node + component of a mesh.
struct SmallModel {
  explicit SmallModel(Mesh part)
      : mesh(std::move(part)),
        held(static_cast<std::size_t>(6 * mesh.nodes()), 0),
        value(Eigen::VectorXd::Zero(6 * mesh.nodes())),
        load(Eigen::VectorXd::Zero(6 * mesh.nodes())) {}

  void hold(int node, Components components) {
    for (int c = 0; c < 6; ++c)
      if ((components >> c) & 1) held[6 * node + c] = 1;
  }
  /// Holds one component at a displacement other than zero.
  void prescribe(int node, int component, double displacement) {
    hold(node, static_cast<Components>(1 << component));
    value[6 * node + component] = displacement;
  }

  Mesh mesh;
  std::vector<char> held;
  Eigen::VectorXd value;  ///< of held coordinates
  Eigen::VectorXd load;   ///< [force; moment] per node, part axes
};

/// The coordinates that are neither held nor empty (without stiffness: rotations of solids), and their matrices.
struct FreeSystem {
  SmallMatrices whole;
  std::vector<int> free;             ///< of each row of S, M: its coordinate 6 node + component
  Eigen::SparseMatrix<double> S, M;  ///< free rows and columns
};

FreeSystem free_system(const SmallModel& model);

/// Eigenvalues of a general matrix. Here, since tests are compiled without optimisation.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

/// Displacements [translation; rotation] of all nodes under the loads and the prescribed displacements.
Eigen::VectorXd solve_small(const SmallModel& model);

/// The lowest `count` squared angular frequencies with modes (columns, M-normalised, six rows per node).
struct SmallModes {
  Eigen::VectorXd omega2;
  Eigen::MatrixXd shape;
  Eigen::VectorXd hertz() const { return omega2.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi); }
};

/// Subspace iteration with (S + shift M)⁻¹ M. `shift` > 0 makes floating bodies regular; of the order of the first
/// elastic ω² is right, and 0 is for bodies that are held. Frequencies to about 1e-9 relative.
SmallModes modes_small(const SmallModel& model, int count, double shift);

}  // namespace tisserand::reducer

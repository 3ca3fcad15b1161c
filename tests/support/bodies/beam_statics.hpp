// SPDX-License-Identifier: GPL-3.0-or-later
// Static equilibrium of a cantilever of beam elements by a dense Newton iteration: the tests' own small solver.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/beam/mesh.hpp"

namespace tisserand::mechanism::test {

/// Dead loads at the last node, world axes.
struct TipLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

struct Cantilever {
  std::vector<NodeMotion> nodes;
  int iterations = 0;      ///< of the last load step
  double last_step = 0.0;  ///< largest increment of the last iteration
  bool converged = false;
};

/// The mesh as a rod of Simo and Reissner, whose twist does not lengthen its fibres: what published numbers belong to.
BeamMesh without_twist_elongation(BeamMesh mesh);

/// Nodes of a mesh at rest in its reference configuration.
std::vector<NodeMotion> reference_nodes(const BeamMesh& mesh);

/// r and A of the whole mesh (6 rows per node), r and A sized and overwritten.
void assemble(const BeamMesh& mesh, const std::vector<NodeMotion>& nodes, const TangentCoefficients& c,
              Eigen::VectorXd& r, Eigen::MatrixXd& A);

/// Clamps node 0 and applies the load in equal steps; each ends when the increment is below `tolerance`.
Cantilever bend_cantilever(const BeamMesh& mesh, const TipLoad& load, int load_steps, double tolerance);

}  // namespace tisserand::mechanism::test

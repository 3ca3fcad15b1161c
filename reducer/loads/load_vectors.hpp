// SPDX-License-Identifier: GPL-3.0-or-later
// Load cases as forces on the coordinates of the system, for statics and for projection by a reduction.
#pragma once

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"
#include "reducer/system/system.hpp"

namespace tisserand::reducer {

/// Nodal forces of all load cases.
struct LoadVectors {
  Eigen::MatrixXd x;        ///< coordinates of the mesh x cases: forces f without gravity
  Eigen::MatrixXd q;        ///< coordinates q x cases: forces Tᵀ f + M R g, with gravity g
  Eigen::MatrixXd applied;  ///< 6 x cases: resultant [force; moment about the origin of the part frame]
  /// Sum of the magnitudes of the forces on nodes per case (moments are divided by System::length).
  Eigen::VectorXd size;
};

/// Computes the consistent forces of Mesh::load_cases on the coordinates of the mesh and, through its ties, on q. So
/// spiders get the force and moment of their nodes. Gravity g gives the forces M R g with the translations in R. They
/// equal the weights of the elements before ties, since rigid motions satisfy the ties. Throws Error for moments on
/// nodes without rotations and for forces that move only coordinates without stiffness and mass.
LoadVectors load_vectors(const Mesh& mesh, const System& system);

}  // namespace tisserand::reducer

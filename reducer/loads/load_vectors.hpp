// SPDX-License-Identifier: GPL-3.0-or-later
// Load cases as forces on the coordinates of the system, for statics and for projection by a reduction.
#pragma once

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"
#include "reducer/system/system.hpp"

namespace tisserand::reducer {

struct LoadVectors {
  Eigen::MatrixXd x;        ///< coordinates x of the mesh x cases: f, without gravity
  Eigen::MatrixXd q;        ///< coordinates q x cases: Tᵀ f + M R g
  Eigen::MatrixXd applied;  ///< 6 x cases: resultant [force; moment about the origin of the part frame]
  Eigen::VectorXd size;     ///< sum of the magnitudes of the forces on nodes (moments over System::length)
};

/// Consistent forces of Mesh::load_cases on the coordinates of the mesh, transformed through its ties: spiders get the
/// force and moment of their nodes. Gravity g acts through M on the translations of R. This equals the mass of the
/// elements times the translation before ties, which rigid motions satisfy. Throws Error for moments on nodes without
/// rotations and for forces that move only coordinates without stiffness and mass.
LoadVectors load_vectors(const Mesh& mesh, const System& system);

}  // namespace tisserand::reducer

// Load cases as forces on the coordinates of the system: what statics solves for, and what a reduction can project.
#pragma once

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"
#include "reducer/system/system.hpp"

namespace tisserand::reducer {

struct LoadVectors {
  Eigen::MatrixXd x;        ///< coordinates of the mesh x cases: f, without gravity
  Eigen::MatrixXd q;        ///< coordinates q x cases: Tᵀ f + M R g
  Eigen::MatrixXd applied;  ///< 6 x cases: resultant [force; moment about the origin of the part frame]
  Eigen::VectorXd size;     ///< sum of the magnitudes of the forces on nodes (moments over System::length)
};

/// Consistent forces of Mesh::load_cases on the coordinates of the mesh, taken through its ties: spiders get the force
/// and moment of what they lead. Gravity g (translations of R) by M: equal to the mass of the elements times the
/// translation before ties, which rigid motions satisfy. Throws Error for moments on nodes without rotations and for
/// forces that move only coordinates without stiffness and mass.
LoadVectors load_vectors(const Mesh& mesh, const System& system);

}  // namespace tisserand::reducer

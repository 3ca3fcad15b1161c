// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness and geometric stiffness of a loaded part as sparse matrices, for the buckling of the unreduced part.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reducer/second_order/tie_strain.hpp"
#include "reducer/system/system.hpp"

namespace tisserand::reducer {

/// Displacements and loads of the part in linear equilibrium under one load case.
struct LoadedState {
  Eigen::VectorXd q;        ///< displacements of the system's coordinates
  Eigen::VectorXd force;    ///< forces on the coordinates of the mesh, gravity included
  Eigen::Vector3d gravity;  ///< acceleration of gravity, which acts on every mass
};

/// Part, supports and ties that all load cases share.
struct StressedPart {
  const Mesh& mesh;
  const System& system;
  const std::vector<int>& free;  ///< indices of the coordinates q that no support holds, ascending
  const TieForces& ties;         ///< ties, found with the coordinates that `system` leaves independent
  std::string where;             ///< place of the part for messages
};

/// Stiffness S (SymmetricPair::S) and geometric stiffness K_g (SymmetricPair::M) of the free coordinates, with one
/// pattern. The potential energy is ½ φᵀ (S + K_g) φ under loads that keep their size and direction. K_g sums the
/// terms that the companion file projects: second-order strains of the elements (elements/second_order.hpp), of ties
/// under the forces that they transmit (tie_strain.hpp), and of masses with an offset under gravity. `S`: stiffness of
/// the free coordinates. `share` receives the completed share of the elements, 0 to 1. Throws Error for averages of
/// too many nodes.
SymmetricPair stiffness_pair(const StressedPart& part, const LoadedState& state, const SymmetricRows& S,
                             const std::function<void(double)>& share);

/// Note for the user on beam sections whose Wagner constant β is unknown although their shear centre or axes show that
/// it matters. It is empty if there are none.
std::string monosymmetry_note(const Mesh& mesh);

/// Forces of all masses under unit accelerations of x, y, z, before ties: M times the rigid translations (coordinates
/// of the mesh x 3), force per acceleration.
Eigen::MatrixXd mesh_weights(const Mesh& mesh, const System& system);

}  // namespace tisserand::reducer

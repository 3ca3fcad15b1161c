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

/// Linear equilibrium of the part under one load case.
struct LoadedState {
  Eigen::VectorXd q;        ///< displacements of the system's coordinates
  Eigen::VectorXd force;    ///< forces on the coordinates of the mesh, weights included
  Eigen::Vector3d gravity;  ///< acceleration that pulls at every mass
};

/// Data that all loaded states of a part share.
struct StressedPart {
  const Mesh& mesh;
  const System& system;
  const std::vector<int>& free;  ///< coordinates q that no support holds, ascending
  const TieForces& ties;         ///< found with the coordinates that `system` leaves independent
  std::string where;             ///< for messages
};

/// Stiffness S (SymmetricPair::S) and geometric stiffness K_g (SymmetricPair::M) of the free coordinates with one
/// pattern: the potential energy is ½ φᵀ (S + K_g) φ under loads that keep their size and direction. K_g is the sum of
/// the terms that the companion file projects: second-order strains of the elements (elements/second_order.hpp), of
/// ties under the forces that they transmit (tie_strain.hpp), and of masses with an offset under gravity. `S` has rows
/// for the free coordinates. `share` receives the share of the elements that is added. Throws Error for averages of too
/// many nodes.
SymmetricPair stiffness_pair(const StressedPart& part, const LoadedState& state, const SymmetricRows& S,
                             const std::function<void(double)>& share);

/// Note that names beam sections with unknown Wagner's β whose shear centre or axes show that it matters; empty if
/// there are none.
std::string monosymmetry_note(const Mesh& mesh);

/// Weights of all masses before ties: M times the rigid translations (coordinates of the mesh x 3), force per
/// acceleration.
Eigen::MatrixXd mesh_weights(const Mesh& mesh, const System& system);

}  // namespace tisserand::reducer

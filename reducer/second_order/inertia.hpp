// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia of the part in a turning frame, THEORY (81), (85), by the masses of elements: C, E, W, contributions of
// element interiors to N and T, and loads of rigid accelerations, THEORY (94).
#pragma once

#include <array>

#include <Eigen/Core>

#include "reducer/elements/turning_mass.hpp"
#include "reducer/mesh/coordinates.hpp"

namespace tisserand::reducer {

/// Bilinear forms of inertia and inertia loads, summed over the finite elements.
struct FrameInertia {
  TurningForms forms;    ///< Φᵀ A Φ of each form A of TurningForms
  bool turns = false;    ///< true if any mass has rotary inertia
  Eigen::MatrixXd load;  ///< coordinates of the mesh x 12: loads of TurningMass
};

/// Sums the inertia of all elements for the displacements `Phi` (rows: coordinates of the mesh, then auxiliary ones
/// without mass; columns: reduced coordinates). `reference`: point about which rigid rotations turn. Elements are
/// processed in blocks, by `threads` threads.
FrameInertia frame_inertia(const Mesh& mesh, const Coordinates& coordinates, const Eigen::MatrixXd& Phi,
                           const Eigen::Vector3d& reference, int threads);

/// Forces of all masses under unit accelerations of x, y, z: M times the rigid translations (coordinates of the mesh x
/// 3), force per acceleration.
Eigen::MatrixXd translation_loads(const Mesh& mesh, const Coordinates& coordinates);

/// Coordinates of the nodes of one element in the numbering of the mesh: the first coordinate of each node, and `size`
/// (3 or 6) coordinates per node.
struct ElementRows {
  std::array<int, 20> first{};
  int nodes = 0;
  int size = 0;
};
ElementRows element_rows(const Mesh& mesh, const Coordinates& coordinates, int element, Eigen::Index coordinates_of_it);

/// Copies the rows of one element from the displacements of all coordinates.
void gather(const ElementRows& rows, const Eigen::MatrixXd& all, Eigen::Ref<Eigen::MatrixXd> out);
/// Adds the rows of one element to the rows of all coordinates.
void scatter(const ElementRows& rows, const Eigen::MatrixXd& of_element, Eigen::MatrixXd& all);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia of the part in a turning frame, THEORY (81), (85), by the masses of elements: C, E, W, contributions of
// element interiors to N and T, and loads of rigid accelerations, THEORY (94).
#pragma once

#include <array>

#include <Eigen/Core>

#include "reducer/elements/turning_mass.hpp"
#include "reducer/mesh/coordinates.hpp"

namespace tisserand::reducer {

/// Sums over the finite elements.
struct FrameInertia {
  TurningForms forms;    ///< ΦᵀAΦ of each form A
  bool turns = false;    ///< whether any mass has rotary inertia
  Eigen::MatrixXd load;  ///< x 12: loads of TurningMass
};

/// Sums for `Phi`: displacements of the mesh's coordinates (rows; auxiliary ones after them have no mass) for each
/// reduced coordinate. Elements are processed in blocks.
FrameInertia frame_inertia(const Mesh& mesh, const Coordinates& coordinates, const Eigen::MatrixXd& Phi,
                           const Eigen::Vector3d& reference, int threads);

/// M times the rigid translations (coordinates of the mesh x 3), force per acceleration.
Eigen::MatrixXd translation_loads(const Mesh& mesh, const Coordinates& coordinates);

/// First coordinates of the nodes of an element, with `size` coordinates (3 or 6) per node.
struct ElementRows {
  std::array<int, 20> first{};
  int nodes = 0;
  int size = 0;
};
ElementRows element_rows(const Mesh& mesh, const Coordinates& coordinates, int element, Eigen::Index coordinates_of_it);

/// Copies the element's rows from the displacements of all coordinates.
void gather(const ElementRows& rows, const Eigen::MatrixXd& all, Eigen::Ref<Eigen::MatrixXd> out);
/// Adds the element's rows to those of all coordinates.
void scatter(const ElementRows& rows, const Eigen::MatrixXd& of_element, Eigen::MatrixXd& all);

}  // namespace tisserand::reducer

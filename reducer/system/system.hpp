// SPDX-License-Identifier: GPL-3.0-or-later
// Equations of motion of the part in independent coordinates, the basis of all later steps.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reducer/algebra/symmetric_pair.hpp"
#include "reducer/mesh/coordinates.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/ties/elimination.hpp"

namespace tisserand::reducer {

/// System of a part. Coordinates x of the mesh (and auxiliary ones of large averaging spiders) follow q: x = T q. S and
/// M of q are Tᵀ S T, Tᵀ M T.
struct System {
  Coordinates coordinates;        ///< coordinates of the mesh
  Transformation T;               ///< x from q; coordinates without stiffness and mass stay 0
  SymmetricPair matrices;         ///< S and M of q, until a reduction splits them
  Eigen::MatrixXd R;              ///< q x 6: rigid motions about `middle`, rotations divided by `length`
  Eigen::MatrixXd MR;             ///< q x 6: M R
  Eigen::VectorXd mesh_mass;      ///< diagonal of M of the mesh's coordinates, before ties
  Eigen::Vector3d middle;         ///< mean of the nodes
  double length = 1.0;            ///< characteristic length
  std::vector<std::string> name;  ///< names of auxiliary coordinates, whose numbers follow those of the mesh
  int eliminated = 0;             ///< coordinates that ties made dependent
  int redundant = 0;              ///< equations of ties that others imply
  std::vector<int> inactive;      ///< x without stiffness and mass, removed

  int size() const { return T.independent; }
};

/// Numbers the coordinates, assembles, eliminates ties exactly, and removes coordinates with neither stiffness nor
/// mass. `share` receives the share of the elements that is added.
System build_system(
    const Mesh& mesh, const std::string& where, const std::function<void(double)>& share = [](double /*done*/) {});

/// System without a boundary: ties leave the `held` coordinates of the mesh independent.
System build_system(const Mesh& mesh, const std::vector<int>& held, const std::string& where,
                    const std::function<void(double)>& share);

/// Name of x, or of the x that is q, such as "tip (rotation x)".
std::string coordinate_name(const Mesh& mesh, const System& system, int x);

/// Coordinates x that the boundary retains, in the order of Mesh::boundary.
std::vector<int> boundary_coordinates(const Mesh& mesh, const Coordinates& coordinates);

/// Rigid motions R of q about `point`, rotations not scaled, and their momenta M R.
Eigen::MatrixXd rigid_motions_about(const System& system, const Eigen::Vector3d& point);
Eigen::MatrixXd rigid_momenta_about(const System& system, const Eigen::Vector3d& point);

}  // namespace tisserand::reducer

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

/// Equations of motion of a part in independent coordinates q. The coordinates x of the mesh, and auxiliary ones of
/// large averaging spiders, follow from q by x = T q. S and M of q are Tᵀ S T and Tᵀ M T.
struct System {
  Coordinates coordinates;        ///< coordinates of the mesh
  Transformation T;               ///< x from q; coordinates x without stiffness and mass stay 0
  SymmetricPair matrices;         ///< S and M of q, until a reduction splits them
  Eigen::MatrixXd R;              ///< q x 6: rigid motions about `middle`, rotations divided by `length`
  Eigen::MatrixXd MR;             ///< q x 6: momenta M R of the rigid motions
  Eigen::VectorXd mesh_mass;      ///< diagonal of M of the mesh's coordinates, before ties
  Eigen::Vector3d middle;         ///< mean of the nodes
  double length = 1.0;            ///< characteristic length of the mesh, which scales rotations
  std::vector<std::string> name;  ///< names of auxiliary coordinates, whose numbers follow those of the mesh
  int eliminated = 0;             ///< number of coordinates that ties made dependent
  int redundant = 0;              ///< number of equations of ties that other equations imply
  std::vector<int> inactive;      ///< coordinates x without stiffness and mass, which were removed

  int size() const { return T.independent; }
};

/// Builds the system of a part: numbers the coordinates, assembles, eliminates ties exactly, and removes coordinates
/// with neither stiffness nor mass. The boundary coordinates stay independent. `share` receives the completed share of
/// the elements, 0 to 1.
System build_system(
    const Mesh& mesh, const std::string& where, const std::function<void(double)>& share = [](double /*done*/) {});

/// Builds the system of a part without a boundary. Ties leave the coordinates `held` of the mesh independent. `share`
/// receives the completed share of the elements, 0 to 1.
System build_system(const Mesh& mesh, const std::vector<int>& held, const std::string& where,
                    const std::function<void(double)>& share);

/// Name of x, or of the x that is q, such as "tip (rotation x)".
std::string coordinate_name(const Mesh& mesh, const System& system, int x);

/// Coordinates x of the mesh that the boundary retains, in the order of Mesh::boundary.
std::vector<int> boundary_coordinates(const Mesh& mesh, const Coordinates& coordinates);

/// Rigid motions R of the coordinates q about `point` (q x 6), with rotations that are not scaled.
/// rigid_momenta_about() gives their momenta M R.
Eigen::MatrixXd rigid_motions_about(const System& system, const Eigen::Vector3d& point);
Eigen::MatrixXd rigid_momenta_about(const System& system, const Eigen::Vector3d& point);

}  // namespace tisserand::reducer

// Inertia of the part in a turning frame: from masses of elements to C, E and the loads of rigid accelerations.
#pragma once

#include <array>

#include <Eigen/Core>

#include "reducer/mesh/coordinates.hpp"

namespace tisserand::reducer {

/// Integrals over the finite elements; [e_k x] acts on the translations and on the rotations of every node.
struct FrameInertia {
  std::array<Eigen::MatrixXd, 3> C;  ///< Φᵀ M [e_k x] Φ
  std::array<Eigen::MatrixXd, 6> E;  ///< ½ ([e_j x]Φ)ᵀ M [e_k x]Φ + transpose, pairs xx yy zz yz xz xy
  Eigen::MatrixXd MD;                ///< x 6: M D, forces of unit accelerations of the rigid part
};

/// `Phi`: displacements of the mesh's coordinates (rows; auxiliary ones behind them are without mass) for each reduced
/// coordinate, D: for the six rigid motions. Elements in blocks: memory for about 4096 rows of each product.
FrameInertia frame_inertia(const Mesh& mesh, const Coordinates& coordinates, const Eigen::MatrixXd& Phi,
                           const Eigen::MatrixXd& D, int threads);

/// [e_k x] on translations and rotations: rows in groups of three.
Eigen::MatrixXd crossed(int k, const Eigen::MatrixXd& rows);

/// The first coordinate of each node of an element, `size` coordinates (3 or 6) per node.
struct ElementRows {
  std::array<int, 20> first{};
  int nodes = 0;
  int size = 0;
};
ElementRows element_rows(const Mesh& mesh, const Coordinates& coordinates, int element, Eigen::Index coordinates_of_it);

/// The element's rows of displacements of all coordinates.
void gather(const ElementRows& rows, const Eigen::MatrixXd& all, Eigen::Ref<Eigen::MatrixXd> out);

}  // namespace tisserand::reducer

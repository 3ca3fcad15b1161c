// From the mesh to the sparse matrices S and M of the whole part.
#pragma once

#include "reducer/mesh.hpp"
#include "reducer/petsc.hpp"

namespace tisserand::reducer {

/// S and M of all 6 N coordinates (node by node: three translations, three rotations, part axes), stored as symmetric
/// 6 x 6 blocks (SBAIJ), both with the pattern of the node graph.
struct SystemMatrices {
  Matrix stiffness;
  Matrix mass;
};

/// Coordinates of the whole part: six per node.
int coordinate_count(const Mesh& mesh);

/// The six rigid motions (coordinates x 6): unit translations, then (e_k × X_a, e_k) about the part origin.
Eigen::MatrixXd rigid_motions(const Mesh& mesh);

/// Sum of the elements and of the nodal masses; memory is reserved exactly from the node graph.
SystemMatrices assemble(const Mesh& mesh);

}  // namespace tisserand::reducer

// Assembly of element matrices into PETSc's symmetric block storage.
#include "reducer/assembly.hpp"

#include <algorithm>
#include <vector>

#include <petscmat.h>

#include "common/rotation.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

using Block12 = Eigen::Matrix<double, 12, 12, Eigen::RowMajor>;
using Block6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// Blocks per block row of the upper triangle, the diagonal included; parallel beams between two nodes count once.
std::vector<PetscInt> upper_blocks(const Mesh& mesh) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(mesh.beams.size());
  for (const BeamElement& beam : mesh.beams) edges.push_back(std::minmax(beam.first, beam.second));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<PetscInt> count(static_cast<std::size_t>(mesh.nodes()), 1);
  for (const auto& [low, high] : edges) ++count[static_cast<std::size_t>(low)];
  return count;
}

Matrix empty_matrix(int nodes, const std::vector<PetscInt>& blocks) {
  Matrix matrix;
  petsc_check(MatCreateSeqSBAIJ(PETSC_COMM_SELF, 6, 6 * nodes, 6 * nodes, 0, blocks.data(), matrix.out()));
  petsc_check(MatSetOption(matrix.get(), MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  petsc_check(MatSetOption(matrix.get(), MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE));
  return matrix;
}

void add(const Matrix& matrix, const BeamElement& beam, const Matrix12& values) {
  const Block12 rows = values;
  const PetscInt nodes[2] = {beam.first, beam.second};
  petsc_check(MatSetValuesBlocked(matrix.get(), 2, nodes, 2, nodes, rows.data(), ADD_VALUES));
}

void finish(const Matrix& matrix) {
  petsc_check(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY));
  petsc_check(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY));
}

}  // namespace

int coordinate_count(const Mesh& mesh) { return 6 * mesh.nodes(); }

Eigen::MatrixXd rigid_motions(const Mesh& mesh) {
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(coordinate_count(mesh), 6);
  for (int a = 0; a < mesh.nodes(); ++a) {
    R.block<6, 6>(6 * a, 0).setIdentity();
    R.block<3, 3>(6 * a, 3) = -skew<double>(mesh.position.col(a));
  }
  return R;
}

SystemMatrices assemble(const Mesh& mesh) {
  const std::vector<PetscInt> blocks = upper_blocks(mesh);
  SystemMatrices system{empty_matrix(mesh.nodes(), blocks), empty_matrix(mesh.nodes(), blocks)};
  ElementMatrices element;
  for (const BeamElement& beam : mesh.beams) {
    element_matrices(mesh, beam, element);
    add(system.stiffness, beam, element.S);
    add(system.mass, beam, element.M);
  }
  for (const NodalMass& point : mesh.masses) {
    Block6 block = Block6::Zero();
    block.topLeftCorner<3, 3>().diagonal().setConstant(point.mass);
    block.bottomRightCorner<3, 3>() = point.inertia;
    const PetscInt node = point.node;
    petsc_check(MatSetValuesBlocked(system.mass.get(), 1, &node, 1, &node, block.data(), ADD_VALUES));
  }
  finish(system.stiffness);
  finish(system.mass);
  return system;
}

}  // namespace tisserand::reducer

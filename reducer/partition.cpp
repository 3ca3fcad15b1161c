// Partition of the coordinates and extraction of the blocks.
#include "reducer/partition.hpp"

#include <utility>

#include <petscmat.h>

namespace tisserand::reducer {
namespace {

struct SplitMatrix {
  Matrix II;
  Eigen::SparseMatrix<double> IB;
  Eigen::MatrixXd BB;
};

/// II as a symmetric matrix again (upper triangle): the coordinates of a node may be torn apart, so blocks of one.
Matrix internal_block(Mat full, const Partition& p) {
  IS rows = nullptr;
  petsc_check(
      ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(p.n_I()), p.internal.data(), PETSC_COPY_VALUES, &rows));
  Matrix general, symmetric;
  petsc_check(MatCreateSubMatrix(full, rows, rows, MAT_INITIAL_MATRIX, general.out()));
  ISDestroy(&rows);
  petsc_check(MatSetOption(general.get(), MAT_SYMMETRIC, PETSC_TRUE));
  petsc_check(MatConvert(general.get(), MATSEQSBAIJ, MAT_INITIAL_MATRIX, symmetric.out()));
  return symmetric;
}

SplitMatrix split_one(const Matrix& matrix, const Partition& p) {
  Matrix full;
  petsc_check(MatConvert(matrix.get(), MATSEQAIJ, MAT_INITIAL_MATRIX, full.out()));
  std::vector<int> internal_row(static_cast<std::size_t>(p.n_B() + p.n_I()), -1), boundary_row(internal_row);
  for (Eigen::Index i = 0; i < p.n_I(); ++i) internal_row[p.internal[i]] = static_cast<int>(i);
  for (Eigen::Index b = 0; b < p.n_B(); ++b) boundary_row[p.boundary[b]] = static_cast<int>(b);
  SplitMatrix result{{}, Eigen::SparseMatrix<double>(p.n_I(), p.n_B()), Eigen::MatrixXd::Zero(p.n_B(), p.n_B())};
  std::vector<Eigen::Triplet<double>> coupling;
  for (Eigen::Index b = 0; b < p.n_B(); ++b) {
    PetscInt count = 0;
    const PetscInt* column = nullptr;
    const PetscScalar* value = nullptr;
    petsc_check(MatGetRow(full.get(), p.boundary[b], &count, &column, &value));
    for (PetscInt k = 0; k < count; ++k) {
      if (boundary_row[column[k]] >= 0)
        result.BB(b, boundary_row[column[k]]) = value[k];
      else
        coupling.emplace_back(internal_row[column[k]], b, value[k]);
    }
    petsc_check(MatRestoreRow(full.get(), p.boundary[b], &count, &column, &value));
  }
  result.IB.setFromTriplets(coupling.begin(), coupling.end());
  if (p.n_I() > 0) result.II = internal_block(full.get(), p);
  return result;
}

}  // namespace

Partition partition(const Mesh& mesh) {
  Partition p;
  std::vector<bool> retained(static_cast<std::size_t>(coordinate_count(mesh)), false);
  for (std::size_t b = 0; b < mesh.boundary.size(); ++b)
    for (int component = 0; component < 6; ++component) {
      if (!(component < 3 ? mesh.boundary[b].translations : mesh.boundary[b].rotations)) continue;
      p.boundary.push_back(6 * mesh.boundary[b].node + component);
      p.boundary_node.push_back(static_cast<int>(b));
      p.boundary_component.push_back(component);
      retained[p.boundary.back()] = true;
    }
  for (int i = 0; i < coordinate_count(mesh); ++i)
    if (!retained[i]) p.internal.push_back(i);
  return p;
}

Blocks split(const SystemMatrices& system, const Partition& p) {
  SplitMatrix S = split_one(system.stiffness, p);
  SplitMatrix M = split_one(system.mass, p);
  return {std::move(S.II), std::move(M.II), std::move(S.IB), std::move(M.IB), std::move(S.BB), std::move(M.BB)};
}

Eigen::MatrixXd rows(const Eigen::MatrixXd& all, const std::vector<int>& which) { return all(which, Eigen::all); }

}  // namespace tisserand::reducer

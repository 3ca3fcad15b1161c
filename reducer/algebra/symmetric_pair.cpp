// Products with pairs of symmetric matrices, and their way to PETSc.
#include "reducer/algebra/symmetric_pair.hpp"

#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <petscmat.h>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

Matrix symmetric_matrix(const std::shared_ptr<SymmetricPair>& pair, std::vector<double>& values) {
  Matrix matrix;
  const PetscInt n = pair->size();
  petsc_check(MatCreateSeqSBAIJWithArrays(PETSC_COMM_SELF, 1, n, n, pair->begin.data(), pair->column.data(),
                                          values.data(), matrix.out()));
  matrix.keep_alive(pair);
  return matrix;
}

}  // namespace

Eigen::MatrixXd multiply(const SymmetricPair& pair, const std::vector<double>& values, const Eigen::MatrixXd& X) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor in = X;
  RowMajor out = RowMajor::Zero(X.rows(), X.cols());
  for (int i = 0; i < pair.size(); ++i)
    for (int k = pair.begin[i]; k < pair.begin[static_cast<std::size_t>(i) + 1]; ++k) {
      const int j = pair.column[k];
      const double value = values[k];
      out.row(i) += value * in.row(j);
      if (j != i) out.row(j) += value * in.row(i);
    }
  return out;
}

SystemMatrices to_petsc(SymmetricPair pair) {
  const auto kept = std::make_shared<SymmetricPair>(std::move(pair));
  return {symmetric_matrix(kept, kept->S), symmetric_matrix(kept, kept->M)};
}

void check_entry_count(long entries) {
  if (entries < std::numeric_limits<int>::max()) return;
  throw Error(fmt::format("the stiffness has {:.3g} entries, more than PETSc's 32-bit indices can count",
                          static_cast<double>(entries)),
              "assembly", "use fewer elements");
}

}  // namespace tisserand::reducer

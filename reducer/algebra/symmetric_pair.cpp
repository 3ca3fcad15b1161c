// SPDX-License-Identifier: GPL-3.0-or-later
// Products with pairs of symmetric matrices, and their conversion to PETSc.
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

SymmetricRows symmetric_rows(const SymmetricPair& pair, const std::vector<double>& values) {
  return {pair.size(), pair.begin.data(), pair.column.data(), values.data()};
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

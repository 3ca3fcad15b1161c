// SPDX-License-Identifier: GPL-3.0-or-later
// S and M over one list of rows from the entries of foreign matrices.
#include "reducer/exchange/reduced_matrices.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/mesh/coordinates.hpp"

namespace tisserand::reducer::exchange {
namespace {

constexpr double symmetry_accepted = 1e-6;  ///< for texts of single precision; more is no rounding

std::string where(const TextMatrix& matrix, const MatrixEntry& entry) {
  return entry.line > 0 ? fmt::format("{}:{}", matrix.file, entry.line) : matrix.file;
}

using RowNumbers = std::map<RowKey, Eigen::Index>;

RowNumbers number_rows(const ReducedMatrices& matrices) {
  RowNumbers numbers;
  for (std::size_t i = 0; i < matrices.rows.size(); ++i)
    if (!numbers.emplace(matrices.rows[i], static_cast<Eigen::Index>(i)).second)
      throw Error(fmt::format("row {} is {}, which is already an earlier row", i + 1, key_text(matrices.rows[i])),
                  matrices.source, "give every coordinate one row");
  return numbers;
}

Eigen::Index find_row(const RowNumbers& numbers, const RowKey& key, const TextMatrix& matrix, const MatrixEntry& e) {
  const auto found = numbers.find(key);
  if (found == numbers.end())
    throw Error(fmt::format("{} has an entry for {}, which is not a row", matrix.title, key_text(key)),
                where(matrix, e), "add the row to the table of rows, or remove the entry");
  return found->second;
}

Eigen::MatrixXd dense(const TextMatrix& matrix, const RowNumbers& numbers) {
  const auto n = static_cast<Eigen::Index>(numbers.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::Matrix<char, Eigen::Dynamic, Eigen::Dynamic> given =
      Eigen::Matrix<char, Eigen::Dynamic, Eigen::Dynamic>::Zero(n, n);
  for (const MatrixEntry& e : matrix.entries) {
    const Eigen::Index i = find_row(numbers, e.row, matrix, e), j = find_row(numbers, e.column, matrix, e);
    if (!std::isfinite(e.value))
      throw Error(
          fmt::format("{}: the entry for {} and {} is not finite", matrix.title, key_text(e.row), key_text(e.column)),
          where(matrix, e), "correct the number");
    if (given(i, j) != 0)
      throw Error(
          fmt::format("{}: the entry for {} and {} is given twice", matrix.title, key_text(e.row), key_text(e.column)),
          where(matrix, e), "give every entry once");
    given(i, j) = 1;
    A(i, j) = e.value;
    if (matrix.storage == Storage::one_triangle && given(j, i) == 0) A(j, i) = e.value;
  }
  return A;
}

/// Replaces A by its symmetric part and returns the removed part. Throws Error if it was more than rounding.
double symmetrise(const TextMatrix& matrix, const std::vector<RowKey>& rows, Eigen::MatrixXd& A) {
  double worst = 0.0;
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i < j; ++i) {
      const double difference = std::abs(A(i, j) - A(j, i));
      if (difference == 0.0) continue;
      const double diagonal = std::sqrt(std::abs(A(i, i))) * std::sqrt(std::abs(A(j, j)));
      const double scale = diagonal > 0.0 ? diagonal : std::max(std::abs(A(i, j)), std::abs(A(j, i)));
      worst = std::max(worst, difference / scale);
      if (!(difference <= symmetry_accepted * scale))
        throw Error(
            fmt::format("{} is not symmetric: the entry for {} and {} is {}, but the transposed entry is {}",
                        matrix.title, key_text(rows[i]), key_text(rows[j]), A(i, j), A(j, i)),
            matrix.file,
            "export stiffness and mass without follower loads, damping and gyroscopic terms; if the file holds one "
            "triangle only, its header must say so");
      const double mean = A(i, j) + 0.5 * (A(j, i) - A(i, j));
      A(i, j) = A(j, i) = mean;
    }
  return worst;
}

}  // namespace

std::string key_text(const RowKey& key) {
  if (key.component == scalar_component) return fmt::format("scalar point {}", key.node);
  if (key.component < 0 || key.component > 5) return fmt::format("node {}, component {}", key.node, key.component + 1);
  return fmt::format("node {}, {}", key.node, component_text(key.component));
}

void add_entry(TextMatrix& matrix, const MatrixEntry& entry) {
  if (matrix.entries.size() == most_rows * most_rows)
    throw Error(fmt::format("{} has more than {} entries", matrix.title, matrix.entries.size()), where(matrix, entry),
                "give reduced matrices");
  matrix.entries.push_back(entry);
}

bool is_internal(const ReducedMatrices& matrices, const RowKey& key) {
  return key.component == scalar_component || key.node < 0 || matrices.modal.contains(key.node);
}

void fill(const TextMatrix& stiffness, const TextMatrix& mass, ReducedMatrices& matrices) {
  if (matrices.rows.empty() || matrices.rows.size() > most_rows)
    throw Error(fmt::format("the matrices have {} rows, expected 1 to {}", matrices.rows.size(), most_rows),
                matrices.source, "give reduced matrices");
  const RowNumbers numbers = number_rows(matrices);
  matrices.stiffness = dense(stiffness, numbers);
  matrices.mass = dense(mass, numbers);
  matrices.stiffness_asymmetry = symmetrise(stiffness, matrices.rows, matrices.stiffness);
  matrices.mass_asymmetry = symmetrise(mass, matrices.rows, matrices.mass);
}

void assemble(const TextMatrix& stiffness, const TextMatrix& mass, ReducedMatrices& matrices) {
  std::set<RowKey> boundary, internal;
  for (const TextMatrix* matrix : {&stiffness, &mass}) {
    if (matrix->entries.empty())
      throw Error(fmt::format("{} has no entries", matrix->title), matrix->file, "give both stiffness and mass");
    for (const MatrixEntry& e : matrix->entries)
      for (const RowKey& key : {e.row, e.column}) (is_internal(matrices, key) ? internal : boundary).insert(key);
  }
  matrices.rows.assign(boundary.begin(), boundary.end());
  matrices.rows.insert(matrices.rows.end(), internal.begin(), internal.end());
  fill(stiffness, mass, matrices);
}

}  // namespace tisserand::reducer::exchange

// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetric matrices to and from HDF5. Sizes are checked before memory is allocated.
#include "formats/companion/arrays.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "common/error.hpp"

namespace tisserand::formats {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void unpack(const double* values, Eigen::Index n, Eigen::MatrixXd& matrix) {
  matrix.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index l = k; l < n; ++l) matrix(k, l) = matrix(l, k) = *values++;
}

/// One accepted shape of a dataset of matrices, with its description for messages.
struct Form {
  hdf5::Shape shape;
  const char* words;
};

/// Reads n x n matrices stored in one of these forms: upper triangles if the last axis is shorter than n².
void read_matrices(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n,
                   const std::vector<Form>& forms, std::span<Eigen::MatrixXd> matrices) {
  const hdf5::Shape found = file.info(dataset).shape;
  const std::string meaning = fmt::format("n = {} coordinates of the superelement", n);
  if (std::ranges::find(forms, found, &Form::shape) == forms.end()) {
    std::string expected;
    for (const Form& form : forms)
      expected += fmt::format("{}{}{}", expected.empty() ? "" : " or ", hdf5::shape_text(form.shape), form.words);
    throw Error(
        fmt::format("has shape {}, expected {} ({})", hdf5::shape_text(found), expected, meaning),
        fmt::format("{}: {}", file.path(), dataset),
        "compare the file with formats/COMPANION.md, or write it again with the program that made the superelement");
  }
  std::vector<double> values(std::accumulate(found.begin(), found.end(), std::uint64_t{1}, std::multiplies<>()));
  file.read(dataset, found, meaning, values.data());
  const auto size = static_cast<Eigen::Index>(n);
  const std::uint64_t each = values.size() / matrices.size();
  for (std::size_t i = 0; i < matrices.size(); ++i)
    if (each == n * n)
      matrices[i] = Eigen::Map<const RowMajor>(values.data() + i * each, size, size);
    else
      unpack(values.data() + i * each, size, matrices[i]);
}

constexpr const char* triangles = " (upper triangles)";

}  // namespace

std::vector<double> upper_triangles(std::span<const Eigen::MatrixXd> matrices) {
  std::vector<double> values;
  for (const Eigen::MatrixXd& matrix : matrices)
    for (Eigen::Index k = 0; k < matrix.rows(); ++k)
      for (Eigen::Index l = k; l < matrix.cols(); ++l) values.push_back(matrix(k, l));
  return values;
}

void read_symmetric(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n,
                    std::span<Eigen::MatrixXd> matrices) {
  const std::uint64_t count = matrices.size();
  read_matrices(file, dataset, n, {{{count, n * (n + 1) / 2}, triangles}, {{count, n, n}, ""}}, matrices);
}

Eigen::MatrixXd read_symmetric(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n) {
  Eigen::MatrixXd matrix;
  read_matrices(file, dataset, n, {{{n * (n + 1) / 2}, triangles}, {{n, n}, ""}}, {&matrix, 1});
  return matrix;
}

void read_general(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n,
                  std::span<Eigen::MatrixXd> matrices) {
  read_matrices(file, dataset, n, {{{matrices.size(), n, n}, ""}}, matrices);
}

}  // namespace tisserand::formats

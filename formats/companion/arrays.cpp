// Symmetric matrices in and out of HDF5; sizes are compared before memory is taken.
#include "formats/companion/arrays.hpp"

#include "common/error.hpp"

namespace tisserand::formats {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

[[noreturn]] void fail_shape(const hdf5::InputFile& file, const std::string& dataset, const hdf5::Shape& found,
                             const std::string& expected) {
  throw Error(
      fmt::format("has shape {}, expected {}", hdf5::shape_text(found), expected),
      fmt::format("{}: {}", file.path(), dataset),
      "compare the file with formats/COMPANION.md, or let the program that made the superelement write it again");
}

void unpack(const double* values, Eigen::Index n, Eigen::MatrixXd& matrix) {
  matrix.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index l = k; l < n; ++l) matrix(k, l) = matrix(l, k) = *values++;
}

/// Reads the values of a dataset whose shape is `packed` (triangles) or `whole`.
void read_either(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n, const hdf5::Shape& packed,
                 const hdf5::Shape& whole, Eigen::MatrixXd* matrices, std::uint64_t count) {
  const hdf5::Shape found = file.info(dataset).shape;
  const std::string meaning = fmt::format("n = {} coordinates of the superelement", n);
  if (found != packed && found != whole)
    fail_shape(
        file, dataset, found,
        fmt::format("{} (upper triangles) or {} ({})", hdf5::shape_text(packed), hdf5::shape_text(whole), meaning));
  const auto size = static_cast<Eigen::Index>(n);
  const std::uint64_t each = found == packed ? n * (n + 1) / 2 : n * n;
  std::vector<double> values(count * each);
  file.read(dataset, found, meaning, values.data());
  for (std::uint64_t i = 0; i < count; ++i) {
    if (found == packed)
      unpack(values.data() + i * each, size, matrices[i]);
    else
      matrices[i] = Eigen::Map<const RowMajor>(values.data() + i * each, size, size);
  }
}

}  // namespace

std::vector<double> upper_triangles(const Eigen::MatrixXd* matrices, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    for (Eigen::Index k = 0; k < matrices[i].rows(); ++k)
      for (Eigen::Index l = k; l < matrices[i].cols(); ++l) values.push_back(matrices[i](k, l));
  return values;
}

void read_symmetric(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n, Eigen::MatrixXd* matrices,
                    std::uint64_t count) {
  read_either(file, dataset, n, {count, n * (n + 1) / 2}, {count, n, n}, matrices, count);
}

Eigen::MatrixXd read_symmetric(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n) {
  Eigen::MatrixXd matrix;
  read_either(file, dataset, n, {n * (n + 1) / 2}, {n, n}, &matrix, 1);
  return matrix;
}

void read_general(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n, Eigen::MatrixXd* matrices,
                  std::uint64_t count) {
  const hdf5::Shape found = file.info(dataset).shape, shape{count, n, n};
  const std::string meaning = fmt::format("n = {} coordinates of the superelement", n);
  if (found != shape) fail_shape(file, dataset, found, fmt::format("{} ({})", hdf5::shape_text(shape), meaning));
  std::vector<double> values(count * n * n);
  file.read(dataset, shape, meaning, values.data());
  const auto size = static_cast<Eigen::Index>(n);
  for (std::uint64_t i = 0; i < count; ++i)
    matrices[i] = Eigen::Map<const RowMajor>(values.data() + i * n * n, size, size);
}

}  // namespace tisserand::formats

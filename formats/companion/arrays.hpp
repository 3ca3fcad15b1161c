// Arrays of companion files between memory and HDF5: symmetric ones as upper triangles or whole.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/hdf5/file.hpp"

namespace tisserand::formats {

/// Entries (k, l), k ≤ l, row by row: n(n + 1)/2 of each matrix, one matrix after the other.
std::vector<double> upper_triangles(std::span<const Eigen::MatrixXd> matrices);

/// Reads symmetric matrices n x n: shape count x n(n + 1)/2 (upper triangles) or count x n x n (whole; may turn out not
/// to be symmetric, which check() tells).
void read_symmetric(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n,
                    std::span<Eigen::MatrixXd> matrices);

/// The same of one matrix: shape n(n + 1)/2 or n x n.
Eigen::MatrixXd read_symmetric(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n);

/// Matrices n x n, row by row: shape count x n x n.
void read_general(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n,
                  std::span<Eigen::MatrixXd> matrices);

}  // namespace tisserand::formats

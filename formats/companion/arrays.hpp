// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of the arrays of companion files to and from HDF5: symmetric ones as upper triangles or whole.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/hdf5/file.hpp"

namespace tisserand::formats {

/// Upper triangles of symmetric n x n matrices as one list: entries (k, l) with k ≤ l, row by row, n(n + 1)/2 per
/// matrix, one matrix after the other.
std::vector<double> upper_triangles(std::span<const Eigen::MatrixXd> matrices);

/// Reads symmetric n x n matrices of a dataset of shape count x n(n + 1)/2 (upper triangles) or count x n x n (whole).
/// The function accepts whole matrices that are not symmetric; check() reports them.
void read_symmetric(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n,
                    std::span<Eigen::MatrixXd> matrices);

/// Reads one symmetric n x n matrix of a dataset of shape n(n + 1)/2 (upper triangle) or n x n (whole).
Eigen::MatrixXd read_symmetric(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n);

/// Reads n x n matrices of a dataset of shape count x n x n, row by row.
void read_general(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n,
                  std::span<Eigen::MatrixXd> matrices);

}  // namespace tisserand::formats

// SPDX-License-Identifier: GPL-3.0-or-later
// Sparse storage of a constant matrix by columns, and its products with vectors of any scalar.
#pragma once

#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "common/math/column_kernels.hpp"

namespace tisserand::mechanism {

/// Run of non-zero blocks in one column of BlockColumns. Its rows are 4 `first` to 4 (`first` + `blocks`) − 1.
struct ColumnRun {
  int column = 0;
  int first = 0, blocks = 0;
};

/// Matrix stored by columns, in blocks of four rows. Blocks of zeros are not stored.
struct BlockColumns {
  static constexpr int block = 4;  ///< rows of a block, one register

  int rows = 0;  ///< multiple of `block`; zeros fill the last block
  std::vector<ColumnRun> runs;
  std::vector<double> entry;  ///< entries of the runs in their order, `block` numbers per block
};

/// Matrix A in blocks. Entries with a magnitude of at most `nothing` count as zero.
BlockColumns block_columns(const Eigen::MatrixXd& A, double nothing);

/// Adds A x to y. Requires that y has BlockColumns::rows entries.
template <class S>
void multiply_add(const BlockColumns& A, const Eigen::Matrix<S, Eigen::Dynamic, 1>& x,
                  Eigen::Matrix<S, Eigen::Dynamic, 1>& y) {
  const double* entry = A.entry.data();
  for (const ColumnRun& run : A.runs) {
    const S factor = x[run.column];
    S* to = y.data() + Eigen::Index{BlockColumns::block} * run.first;
    for (int b = 0; b < run.blocks; ++b, entry += BlockColumns::block, to += BlockColumns::block) {
      if constexpr (std::is_same_v<S, double>) {
        column_kernels::store(to, column_kernels::load(to) + column_kernels::load(entry) * factor);
      } else {
        for (int i = 0; i < BlockColumns::block; ++i)
          if (entry[i] != 0.0) to[i] += entry[i] * factor;
      }
    }
  }
}

/// Adds A x to y and A w to z in one pass over A. Requires that y and z have BlockColumns::rows entries.
template <class S>
void multiply_add(const BlockColumns& A, const Eigen::Matrix<S, Eigen::Dynamic, 1>& x,
                  Eigen::Matrix<S, Eigen::Dynamic, 1>& y, const Eigen::Matrix<S, Eigen::Dynamic, 1>& w,
                  Eigen::Matrix<S, Eigen::Dynamic, 1>& z) {
  if constexpr (!std::is_same_v<S, double>) {
    multiply_add(A, x, y);
    multiply_add(A, w, z);
  } else {
    const double* entry = A.entry.data();
    for (const ColumnRun& run : A.runs) {
      const double x_k = x[run.column], w_k = w[run.column];
      double* to_y = y.data() + Eigen::Index{BlockColumns::block} * run.first;
      double* to_z = z.data() + Eigen::Index{BlockColumns::block} * run.first;
      for (int b = 0; b < BlockColumns::block * run.blocks; b += BlockColumns::block) {
        const column_kernels::Four e = column_kernels::load(entry + b);
        column_kernels::store(to_y + b, column_kernels::load(to_y + b) + e * x_k);
        column_kernels::store(to_z + b, column_kernels::load(to_z + b) + e * w_k);
      }
      entry += Eigen::Index{BlockColumns::block} * run.blocks;
    }
  }
}

/// Adds Aᵀ x to out. Requires that x has BlockColumns::rows entries.
template <class S>
void multiply_transposed_add(const BlockColumns& A, const Eigen::Matrix<S, Eigen::Dynamic, 1>& x,
                             Eigen::Matrix<S, Eigen::Dynamic, 1>& out) {
  const double* entry = A.entry.data();
  for (const ColumnRun& run : A.runs) {
    const S* by = x.data() + Eigen::Index{BlockColumns::block} * run.first;
    if constexpr (std::is_same_v<S, double>) {
      column_kernels::Four sum = column_kernels::load(entry) * column_kernels::load(by);
      for (int b = 1; b < run.blocks; ++b)
        sum +=
            column_kernels::load(entry + BlockColumns::block * b) * column_kernels::load(by + BlockColumns::block * b);
      out[run.column] += (sum[0] + sum[1]) + (sum[2] + sum[3]);
      entry += Eigen::Index{BlockColumns::block} * run.blocks;
    } else {
      S sum(0.0);
      for (int i = 0; i < BlockColumns::block * run.blocks; ++i, ++entry)
        if (*entry != 0.0) sum += *entry * by[i];
      out[run.column] += sum;
    }
  }
}

}  // namespace tisserand::mechanism

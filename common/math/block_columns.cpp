// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the blocks of columns of a matrix that are not zero.
#include "common/math/block_columns.hpp"

namespace tisserand::mechanism {

BlockColumns block_columns(const Eigen::MatrixXd& A, double nothing) {
  constexpr int block = BlockColumns::block;
  BlockColumns out;
  const auto rows = static_cast<int>(A.rows());
  out.rows = block * ((rows + block - 1) / block);
  Eigen::VectorXd column = Eigen::VectorXd::Zero(out.rows);
  for (int k = 0; k < A.cols(); ++k) {
    column.head(rows) = (A.col(k).array().abs() <= nothing).select(0.0, A.col(k));
    bool open = false;
    for (int b = 0; b < out.rows / block; ++b) {
      const auto numbers = column.segment<block>(Eigen::Index{block} * b);
      const bool present = !numbers.isZero(0.0);
      if (present && !open) out.runs.push_back({k, b, 0});
      open = present;
      if (!present) continue;
      ++out.runs.back().blocks;
      out.entry.insert(out.entry.end(), numbers.begin(), numbers.end());
    }
  }
  return out;
}

}  // namespace tisserand::mechanism

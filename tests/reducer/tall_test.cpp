// SPDX-License-Identifier: GPL-3.0-or-later
// Products with a tall matrix against Eigen's, at all remainders of rows, columns and right-hand sides.
#include "reducer/algebra/tall.hpp"

#include <gtest/gtest.h>

namespace tisserand::reducer::tall_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Sums of up to 300 products of numbers below 1: round-off below 300 ε.
TEST(Tall, ProductsAreThoseOfEigen) {
  for (const Index n : {1, 7, 128, 129, 300})
    for (const Index k : {0, 1, 3, 4, 5, 13})
      for (const Index b : {1, 7, 8, 9, 16, 17}) {
        const MatrixXd whole = MatrixXd::Random(n + 3, k + 2);
        const auto A = whole.block(2, 1, n, k);  // a stride of its own
        const MatrixXd B = MatrixXd::Random(n, b), factor = MatrixXd::Random(k, b);
        const MatrixXd inner = tall_inner_products(A, B);
        ASSERT_EQ(inner.rows(), k);
        ASSERT_EQ(inner.cols(), b);
        EXPECT_LT((inner - A.transpose() * B).cwiseAbs().sum(), 1e-12 * static_cast<double>(k * b) + 1e-300);
        MatrixXd C = B;
        subtract_tall_product(A, factor, C);
        EXPECT_LT((C - (B - A * factor)).cwiseAbs().maxCoeff(), 1e-13);
      }
}

}  // namespace
}  // namespace tisserand::reducer::tall_test

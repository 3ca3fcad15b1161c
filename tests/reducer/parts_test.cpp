// SPDX-License-Identifier: GPL-3.0-or-later
// That the parts of the tests are what they promise.
#include <gtest/gtest.h>

#include "tests/reducer/parts.hpp"

namespace tisserand::testing::parts_test {

TEST(Parts, FrequenciesOfTheFrameAreSingle) {
  const reducer::Reduction reduction = reduce(space_frame(30));
  const Eigen::VectorXd lambda = reduction.superelement.stiffness.diagonal().tail(30);
  for (int k = 1; k < 30; ++k) EXPECT_GT(lambda[k] - lambda[k - 1], 1e-4 * lambda[k]) << "mode " << k;
}

}  // namespace tisserand::testing::parts_test

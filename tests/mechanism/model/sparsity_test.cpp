// SPDX-License-Identifier: GPL-3.0-or-later
// The entries that the iteration matrix does not store are zero at random states, and those it stores are needed.
#include "mechanism/model/sparsity.hpp"

#include <random>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "tests/support/scenes/joint_kinds.hpp"

namespace tisserand::mechanism::sparsity_test {
namespace {

using Eigen::Vector3d;

class Sparsity : public ::testing::TestWithParam<JointKind> {
 protected:
  Vector3d vector() { return {normal_(random_), normal_(random_), normal_(random_)}; }
  NodeMotion node() {
    NodeMotion n;
    n.x = vector();
    n.R = exp_so3<double>(vector());
    n.xd = vector();
    n.Omega = vector();
    return n;
  }
  Joint joint(bool offset) {
    Joint joint;
    set_relations(GetParam(), {true, false, true, true, false, true}, joint);
    for (Marker* marker : {&joint.a, &joint.b}) {
      marker->p = offset ? vector() : Vector3d::Zero();
      marker->R = exp_so3<double>(vector());
    }
    return joint;
  }

 private:
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

/// Counts entries that were nonzero at least once, and demands that they are flagged.
template <class Matrix>
void mark(const Matrix& values, int rows, const EntryFlags& flags, EntryFlags& seen) {
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < rows; ++i) {
      const auto at = static_cast<std::size_t>(i + rows * j);
      if (values(i, j) == 0.0) continue;
      seen[at] = true;
      EXPECT_TRUE(flags[at]) << i << ", " << j;
    }
}

TEST_P(Sparsity, HoldsAllThatIsNotZero) {
  for (const bool offset : {false, true}) {
    const Joint j = joint(offset);
    const int size = j.size();
    const EntryFlags stiffness = stiffness_entries(j), gradient = gradient_entries(j);
    EntryFlags seen_stiffness(stiffness.size(), false), seen_gradient(gradient.size(), false);
    for (int trial = 0; trial < 5; ++trial) {
      const NodeMotion a = node(), b = node();
      JointTerms terms;
      terms.B.setZero();
      joint_constraints(j, a, b, terms);
      mark(terms.B, size, gradient, seen_gradient);
      Eigen::Matrix<double, 6, 12> N;
      joint_rate_gradient(j, a, b, N);
      mark(N, size, gradient, seen_gradient);
      Square12 K;
      const double lambda[6] = {1.0, -0.7, 0.4, 1.3, -0.9, 0.6};
      joint_stiffness(j, a, b, lambda, K);
      mark(K, 12, stiffness, seen_stiffness);
    }
    if (j.coincident) {
      EXPECT_EQ(seen_gradient, gradient);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Sparsity, ::testing::ValuesIn(test_support::every_joint()),
                         test_support::joint_test_name);

}  // namespace
}  // namespace tisserand::mechanism::sparsity_test

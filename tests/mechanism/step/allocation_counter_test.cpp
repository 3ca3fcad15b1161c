// The counting malloc of this test program (tests/support/allocation_counter.hpp), and the proof that it counts.
#include "tests/support/allocation_counter.hpp"

#include <memory>

#include <gtest/gtest.h>
#include <Eigen/Core>

namespace {
thread_local std::size_t count = 0;
}

namespace tisserand::test_support {
std::size_t allocation_count() { return count; }
}  // namespace tisserand::test_support

#if !defined(__SANITIZE_ADDRESS__)
extern "C" void* __libc_malloc(std::size_t size);

extern "C" void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}

TEST(AllocationCounter, CountsStandardAndEigenAllocations) {
  const std::size_t before = tisserand::test_support::allocation_count();
  const auto number = std::make_unique<double>(1.0);
  const std::size_t between = tisserand::test_support::allocation_count();
  Eigen::VectorXd vector(100);
  vector.setConstant(*number);
  const std::size_t after = tisserand::test_support::allocation_count();
  EXPECT_EQ(between - before, 1u);
  EXPECT_EQ(after - between, 1u);
  EXPECT_EQ(vector.sum(), 100.0);
}
#endif

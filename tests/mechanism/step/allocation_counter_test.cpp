// SPDX-License-Identifier: GPL-3.0-or-later
// The counting malloc of this test program (tests/support/allocation_counter.hpp), and the proof that it counts.
#include "tests/support/allocation_counter.hpp"

#include <memory>

#include <gtest/gtest.h>
#include <Eigen/Core>

namespace {
thread_local volatile std::size_t count = 0;  // clang takes operator new for a function that changes nothing here
}

namespace tisserand::test_support {
std::size_t allocation_count() { return count; }
}  // namespace tisserand::test_support

#if !defined(TISSERAND_SANITIZED)
extern "C" void* __libc_malloc(std::size_t size);

/// Visible to shared libraries too: operator new is in one.
extern "C" [[gnu::visibility("default")]] void* malloc(std::size_t size) {
  count = count + 1;
  return __libc_malloc(size);
}

TEST(AllocationCounter, CountsStandardAndEigenAllocations) {
  const std::size_t before = tisserand::test_support::allocation_count();
  const auto number = std::make_unique<double>(1.0);
  [[maybe_unused]] double* volatile escaped = number.get();  // or a compiler may omit the allocation
  const std::size_t between = tisserand::test_support::allocation_count();
  Eigen::VectorXd vector(100);
  vector.setConstant(*number);
  const std::size_t after = tisserand::test_support::allocation_count();
  EXPECT_EQ(between - before, 1u);
  EXPECT_EQ(after - between, 1u);
  EXPECT_EQ(vector.sum(), 100.0);
}
#endif

// SPDX-License-Identifier: GPL-3.0-or-later
// Storing a row takes no memory from the heap between flushes: every malloc of the thread is counted.

#include <cstddef>

#include <gtest/gtest.h>

#include "formats/results/results.hpp"
#include "tests/support/results_rows.hpp"
#include "tests/support/temporary_folder.hpp"

#if !defined(TISSERAND_SANITIZED)

namespace {
thread_local bool counting = false;
thread_local std::size_t allocations = 0;
}  // namespace

extern "C" void* __libc_malloc(std::size_t size);
/// Visible to shared libraries too: operator new is in one.
extern "C" [[gnu::visibility("default")]] void* malloc(std::size_t size) {
  if (counting) ++allocations;
  return __libc_malloc(size);
}

namespace tisserand::formats::results_allocation_test {
namespace {

TEST(ResultsAllocation, AppendTakesNoMemoryBetweenFlushes) {
  const test_support::TemporaryFolder folder;
  const ResultsLayout layout = test_support::example_layout();
  ResultsWriter writer(folder.file("a.h5"), layout);
  ResultsRow row;
  row.resize(layout);
  counting = true;
  for (int t = 0; t < 2000; ++t) {  // less than the rows that can wait, and far less than a second
    test_support::fill_row(t, row);
    writer.append(row);
  }
  counting = false;
  EXPECT_EQ(allocations, 0u);
  counting = true;
  writer.finish(true, "", "{}");
  counting = false;
  EXPECT_GT(allocations, 0u);  // the counter counts
}

}  // namespace
}  // namespace tisserand::formats::results_allocation_test

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
// Stable sorting of objects that need more alignment than the buffer of the standard library gives.
#include "common/stable_sort.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace tisserand {
namespace {

/// Counts how many objects were made at a place that their type does not allow.
struct alignas(64) Wide {
  explicit Wide(int k, int o) : key(k), order(o) { look(); }
  Wide(const Wide& other) : key(other.key), order(other.order) { look(); }
  Wide& operator=(const Wide&) = default;

  void look() {
    if (reinterpret_cast<std::uintptr_t>(this) % alignof(Wide) != 0) ++misplaced;
  }

  int key;
  int order;
  static inline int misplaced = 0;
};

TEST(StableSort, KeepsTheOrderOfEqualElementsAndTheirAlignment) {
  Wide::misplaced = 0;
  std::vector<Wide> list;
  for (int i = 0; i < 1000; ++i) list.emplace_back(i * 7 % 10, i);
  sort_stably(list, std::greater{}, &Wide::key);
  for (std::size_t i = 1; i < list.size(); ++i) {
    ASSERT_GE(list[i - 1].key, list[i].key);
    if (list[i - 1].key == list[i].key) {
      ASSERT_LT(list[i - 1].order, list[i].order);
    }
  }
  EXPECT_EQ(Wide::misplaced, 0);
}

TEST(StableSort, SortsArrays) {
  std::array<int, 3> order{0, 1, 2};
  sort_stably(order, {}, [](int i) { return -i; });
  EXPECT_EQ(order, (std::array{2, 1, 0}));
}

}  // namespace
}  // namespace tisserand

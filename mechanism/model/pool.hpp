// SPDX-License-Identifier: GPL-3.0-or-later
// Pool: all items of one type, and the positions of their rows and columns.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace tisserand::mechanism {

/// Global coordinates of the local rows and columns of an element. −1: absent (ground, or not owned by the node).
/// slots[i + j n] is the index of entry (i, j) in the values of the iteration matrix, −1 if absent.
struct ElementMap {
  std::vector<int> coordinates;
  std::vector<int> slots;
  std::vector<int> carriers;  ///< nodes, if one of them follows a modal body (equations/carriers.hpp); else empty
};

/// Items in the order of the scene; maps[i] belongs to item i once the model is finished.
template <class T>
struct Pool {
  using value_type = T;
  std::vector<T> items;
  std::vector<ElementMap> maps;

  std::size_t size() const { return items.size(); }
  bool empty() const { return items.empty(); }
  T& operator[](std::size_t i) { return items[i]; }
  const T& operator[](std::size_t i) const { return items[i]; }
  auto begin() { return items.begin(); }
  auto end() { return items.end(); }
  auto begin() const { return items.begin(); }
  auto end() const { return items.end(); }
  const T& front() const { return items.front(); }
  T& back() { return items.back(); }
  void push_back(T item) { items.push_back(std::move(item)); }
};

}  // namespace tisserand::mechanism

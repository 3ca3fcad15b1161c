// SPDX-License-Identifier: GPL-3.0-or-later
// Pool: all items of one type, and the positions of their rows and columns.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace tisserand::mechanism {

/// Map of the n local rows and columns of an element to coordinates of the model: −1 if absent (ground, or not owned by
/// the node). slots[i + j n] is the index of entry (i, j) in the stored values of the iteration matrix, −1 if absent.
struct ElementMap {
  std::vector<int> coordinates;
  std::vector<int> slots;
  std::vector<int> carriers;  ///< nodes, if one follows a modal body (equations/carriers.hpp)
};

/// All items of one type, in the order of the scene. maps[i] is the map of item i once the model is finished.
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

// SPDX-License-Identifier: GPL-3.0-or-later
// Hash table of cubes in space.
#include "reducer/sources/node_grid.hpp"

#include <algorithm>
#include <cmath>

#include "common/math/count.hpp"

namespace tisserand::reducer {

NodeGrid::Cube NodeGrid::cube(const Eigen::Vector3d& x) const {
  const auto index = [this](double value) {
    constexpr double largest = 1e15;  // far beyond it neighbours are no longer distinguished, which is harmless
    return static_cast<std::int64_t>(std::clamp(std::floor(value / step_), -largest, largest));
  };
  return {index(x.x()), index(x.y()), index(x.z())};
}

std::size_t NodeGrid::Hash::operator()(const Cube& c) const {
  const auto mix = [](std::uint64_t value) { return (value ^ (value >> 31)) * 0x9E3779B97F4A7C15ULL; };
  return mix(mix(mix(static_cast<std::uint64_t>(c.i)) + static_cast<std::uint64_t>(c.j)) +
             static_cast<std::uint64_t>(c.k));
}

void NodeGrid::add(const Eigen::Vector3d& x, int number) { cubes_[cube(x)].push_back(number); }

int MergedNodes::find(const Eigen::Vector3d& x) const {
  int best = -1;
  double distance = tolerance_;
  grid_.near(x, [&](int number) {
    const double d = (position_[number] - x).norm();
    if (d <= distance) distance = d, best = number;
  });
  return best;
}

int MergedNodes::at(const Eigen::Vector3d& x) {
  if (const int node = find(x); node >= 0) return node;
  const int node = count_of(position_);
  position_.push_back(x);
  grid_.add(x, node);
  return node;
}

}  // namespace tisserand::reducer

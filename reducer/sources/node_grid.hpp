// SPDX-License-Identifier: GPL-3.0-or-later
// Spatial search for points: the node at a place, and nodes nearby.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer {

/// Search grid for points: a hash table of cubes of edge `step`, each with the numbers of the points inside.
class NodeGrid {
 public:
  explicit NodeGrid(double step) : step_(step) {}

  void add(const Eigen::Vector3d& x, int number);
  /// Calls visit(number) for every added point within the distance `step` of `x`. It may also call it for farther
  /// points.
  template <class Visit>
  void near(const Eigen::Vector3d& x, Visit visit) const {
    near(x, step_, visit);
  }
  /// Calls visit(number) for every added point within `distance` of `x`. It may also call it for farther points. For
  /// distances far below the step it mostly searches one cube.
  template <class Visit>
  void near(const Eigen::Vector3d& x, double distance, Visit visit) const {
    const Cube low = cube(x.array() - distance), high = cube(x.array() + distance);
    for (std::int64_t i = low.i; i <= high.i; ++i)
      for (std::int64_t j = low.j; j <= high.j; ++j)
        for (std::int64_t k = low.k; k <= high.k; ++k) {
          const auto found = cubes_.find({i, j, k});
          if (found == cubes_.end()) continue;
          for (const int number : found->second) visit(number);
        }
  }

 private:
  struct Cube {
    std::int64_t i, j, k;
    bool operator==(const Cube&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Cube& c) const;
  };
  Cube cube(const Eigen::Vector3d& x) const;

  double step_;
  std::unordered_map<Cube, std::vector<int>, Hash> cubes_;
};

/// Collection of nodes, of which no two are at the same place within `tolerance`.
class MergedNodes {
 public:
  explicit MergedNodes(double tolerance) : tolerance_(tolerance), grid_(tolerance) {}

  /// Node at the place `x`, or -1 if there is none.
  int find(const Eigen::Vector3d& x) const;
  /// Node at the place `x`, or a new one if there is none.
  int at(const Eigen::Vector3d& x);
  const std::vector<Eigen::Vector3d>& position() const { return position_; }

 private:
  double tolerance_;
  NodeGrid grid_;
  std::vector<Eigen::Vector3d> position_;
};

}  // namespace tisserand::reducer

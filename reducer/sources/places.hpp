// SPDX-License-Identifier: GPL-3.0-or-later
// Places of part.yaml as nodes of the mesh.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "reducer/sources/mesh_builder.hpp"

namespace tisserand::reducer {

/// User of a place, for messages: "boundary node 'tip'" at file:line.
struct User {
  std::string name;
  std::string where;
};

/// Node of a place; positions and centroids make a new one. Throws Error naming the user.
int find_place(MeshBuilder& builder, const formats::Place& place, const User& user);

/// Node with this number in the mesh file. Throws Error with the range of numbers.
int find_file_node(const MeshBuilder& builder, long number, const User& user);

/// Node of the mesh file nearest to x among those of elements. Throws Error if it is farther than the tolerance
/// (absent: 1e-3 of the extent of the file's nodes), or if two are equally near.
int nearest_file_node(const MeshBuilder& builder, const Eigen::Vector3d& x, std::optional<double> tolerance,
                      const User& user);

/// The nearest of some things, and the next one; a choice between two that are equally near would be arbitrary.
struct NearestTwo {
  int best = -1, second = -1;
  double distance = std::numeric_limits<double>::infinity(), next = distance;

  void look_at(int thing, double away) {
    if (away < distance)
      second = best, next = distance, best = thing, distance = away;
    else if (away < next)
      second = thing, next = away;
  }
  bool is_ambiguous(double size) const { return second >= 0 && next - distance <= 1e-9 * size; }
};

}  // namespace tisserand::reducer

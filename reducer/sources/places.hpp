// SPDX-License-Identifier: GPL-3.0-or-later
// Places of part.yaml as nodes of the mesh.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "reducer/sources/mesh_builder.hpp"

namespace tisserand::reducer {

/// Object that refers to a place, for messages: its name, such as "boundary node 'tip'", and file:line.
struct User {
  std::string name;
  std::string where;
};

/// Finds the node at a place of part.yaml. Positions and centroids make a new node. Throws Error that names `user` if
/// there is none.
int find_place(MeshBuilder& builder, const formats::Place& place, const User& user);

/// Finds the node with this number in the mesh file. Throws Error with the range of numbers if there is none.
int find_file_node(const MeshBuilder& builder, long number, const User& user);

/// Finds the node of the mesh file that is nearest to `x`, among those of elements. Throws Error if it is farther than
/// `tolerance` (absent: 1e-3 of the extent of the nodes of the file), or if two are equally near.
int nearest_file_node(const MeshBuilder& builder, const Eigen::Vector3d& x, std::optional<double> tolerance,
                      const User& user);

/// Search for the nearest of some things, which also keeps the second nearest. A choice between two that are equally
/// near would be arbitrary.
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

// SPDX-License-Identifier: GPL-3.0-or-later
// Jacobians of curved cells by gmsh, and its optimisation of second-order nodes.
#include "reducer/gmsh/curved.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmsh.h>

namespace tisserand::reducer {

std::size_t folded_cells() {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 3);
  std::size_t folded = 0;
  for (const int type : types) {
    std::string name;
    int dimension = 0, order = 0, nodes = 0, corners = 0;
    std::vector<double> local, jacobians, determinants, points;
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, local, corners);
    if (order < 2) continue;
    gmsh::model::mesh::getJacobians(type, local, jacobians, determinants, points);
    const auto per_cell = static_cast<std::size_t>(nodes);
    for (std::size_t first = 0; first + per_cell <= determinants.size(); first += per_cell) {
      const auto begin = determinants.begin() + static_cast<std::ptrdiff_t>(first);
      if (*std::min_element(begin, begin + nodes) <= 0.0) ++folded;
    }
  }
  return folded;
}

Unfolding unfold_cells() {
  Unfolding result{folded_cells(), 0};
  if (result.before == 0) return result;
  gmsh::model::mesh::optimize("HighOrder");
  result.after = folded_cells();
  return result;
}

}  // namespace tisserand::reducer

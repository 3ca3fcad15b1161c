// SPDX-License-Identifier: GPL-3.0-or-later
// Shell meshes of the tests: a grid of nodes on a surface x(a, b), with 3- or 4-node elements, supports and loads by
// place.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"
#include "tests/support/meshes/shell_mesh.hpp"
#include "tests/support/meshes/small_model.hpp"

namespace tisserand::reducer {

/// Cells along a and b, and what they are made of. A closed grid joins a = 1 to a = 0.
struct GridShape {
  int na = 1;
  int nb = 1;
  Facets facets = Facets::quadrilaterals;
  bool closed = false;
};

using Surface = std::function<Eigen::Vector3d(double a, double b)>;

/// Node of grid point (i, j), row by row.
int grid_node(const GridShape& grid, int i, int j);

/// a, b from 0 to 1; the normal is ∂x/∂a × ∂x/∂b. Triangles halve the cells by diagonals of alternating direction.
Mesh shell_grid(const GridShape& grid, const Surface& surface, const ShellSection& section);

using Place = std::function<bool(const Eigen::Vector3d&)>;

std::vector<int> nodes_where(const Mesh& mesh, const Place& place);

void hold_where(SmallModel& model, Components components, const Place& place);

int node_at(const Mesh& mesh, const Eigen::Vector3d& point);

/// Area vector (half the product of the diagonals, or of two edges).
Eigen::Vector3d area_vector(const Mesh& mesh, const ShellElement& shell);

/// A force per area of fixed direction, in equal shares to the corners of each element.
void load_area(SmallModel& model, const Eigen::Vector3d& force_per_area);

}  // namespace tisserand::reducer

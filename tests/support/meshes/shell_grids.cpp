// SPDX-License-Identifier: GPL-3.0-or-later
// Grids of shell elements, and their supports and loads by place.
#include "tests/support/meshes/shell_grids.hpp"

#include <array>

#include <Eigen/Geometry>

namespace tisserand::reducer {

int grid_node(const GridShape& grid, int i, int j) {
  return grid.closed ? j * grid.na + i % grid.na : j * (grid.na + 1) + i;
}

Mesh shell_grid(const GridShape& grid, const Surface& surface, const ShellSection& section) {
  Mesh mesh;
  const int columns = grid.closed ? grid.na : grid.na + 1;
  mesh.position.resize(3, columns * (grid.nb + 1));
  for (int j = 0; j <= grid.nb; ++j)
    for (int i = 0; i < columns; ++i)
      mesh.position.col(grid_node(grid, i, j)) =
          surface(static_cast<double>(i) / grid.na, static_cast<double>(j) / grid.nb);
  mesh.node_label.assign(static_cast<std::size_t>(mesh.nodes()), "node");
  mesh.shell_properties.push_back({section, formats::MassMatrix::consistent, "shell"});
  const auto add = [&](std::array<int, 4> nodes) {
    ShellElement shell;
    shell.nodes = nodes;
    mesh.shells.push_back(shell);
  };
  for (int j = 0; j < grid.nb; ++j)
    for (int i = 0; i < grid.na; ++i) {
      const int p = grid_node(grid, i, j), q = grid_node(grid, i + 1, j), r = grid_node(grid, i + 1, j + 1),
                s = grid_node(grid, i, j + 1);
      if (grid.facets == Facets::quadrilaterals) {
        add({p, q, r, s});
      } else if ((i + j) % 2 == 0) {
        add({p, q, r, -1});
        add({p, r, s, -1});
      } else {
        add({p, q, s, -1});
        add({q, r, s, -1});
      }
    }
  return mesh;
}

std::vector<int> nodes_where(const Mesh& mesh, const Place& place) {
  std::vector<int> nodes;
  for (int i = 0; i < mesh.nodes(); ++i)
    if (place(mesh.position.col(i))) nodes.push_back(i);
  return nodes;
}

void hold_where(SmallModel& model, Components components, const Place& place) {
  for (int node : nodes_where(model.mesh, place)) model.hold(node, components);
}

int node_at(const Mesh& mesh, const Eigen::Vector3d& point) {
  Eigen::Index node = 0;
  (mesh.position.colwise() - point).colwise().squaredNorm().minCoeff(&node);
  return static_cast<int>(node);
}

Eigen::Vector3d area_vector(const Mesh& mesh, const ShellElement& shell) {
  const auto X = [&](std::size_t k) -> Eigen::Vector3d { return mesh.position.col(shell.nodes[k]); };
  if (shell.corners() == 3) return 0.5 * (X(1) - X(0)).cross(X(2) - X(0));
  return 0.5 * (X(2) - X(0)).cross(X(3) - X(1));
}

void load_area(SmallModel& model, const Eigen::Vector3d& force_per_area) {
  for (const ShellElement& shell : model.mesh.shells)
    for (int k = 0; k < shell.corners(); ++k)
      model.load.segment<3>(6 * shell.nodes[k]) +=
          force_per_area * area_vector(model.mesh, shell).norm() / shell.corners();
}

}  // namespace tisserand::reducer

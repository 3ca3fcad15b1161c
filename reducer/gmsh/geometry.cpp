// SPDX-License-Identifier: GPL-3.0-or-later
// Queries to gmsh's kernels, some of which may have no answer.
#include "reducer/gmsh/geometry.hpp"

#include <cmath>
#include <string>

#include <gmsh.h>

namespace tisserand::reducer {
namespace {

constexpr int grid_points = 7;  // along each parameter: more points than unknowns of surfaces with an axis

/// Sets length or area and its middle. The kernel of .geo files without OpenCASCADE has none.
void measure(const Entity& entity, double scale, EntityGeometry& geometry) {
  try {
    double size = 0.0, x = 0.0, y = 0.0, z = 0.0;
    gmsh::model::occ::getMass(entity.dimension, entity.number, size);
    gmsh::model::occ::getCenterOfMass(entity.dimension, entity.number, x, y, z);
    const Eigen::Vector3d center = scale * Eigen::Vector3d(x, y, z);
    if (!std::isfinite(size) || !(size > 0.0) || !center.allFinite()) return;
    geometry.size = std::pow(scale, entity.dimension) * size;
    geometry.center = center;
  } catch (const std::string&) {
  }
}

/// Middles of the cells of a grid of parameters, which avoid the edges with poles and seams.
std::vector<double> grid_of(int face) {
  std::vector<double> low, high, grid;
  gmsh::model::getParametrizationBounds(2, face, low, high);
  if (low.size() < 2 || high.size() < 2) return grid;
  const auto at = [&](std::size_t axis, int k) {
    return low[axis] + (high[axis] - low[axis]) * (k + 0.5) / grid_points;
  };
  for (int i = 0; i < grid_points; ++i)
    for (int j = 0; j < grid_points; ++j) {
      grid.push_back(at(0, i));
      grid.push_back(at(1, j));
    }
  return grid;
}

void sample(int face, double scale, EntityGeometry& geometry) {
  try {
    std::vector<double> point, normal;
    const std::vector<double> grid = grid_of(face);
    gmsh::model::getValue(2, face, grid, point);
    gmsh::model::getNormal(face, grid, normal);
    for (std::size_t k = 0; k + 3 <= point.size() && k + 3 <= normal.size(); k += 3) {
      const Eigen::Vector3d x = scale * Eigen::Vector3d(point[k], point[k + 1], point[k + 2]);
      const Eigen::Vector3d n(normal[k], normal[k + 1], normal[k + 2]);
      if (!x.allFinite() || !n.allFinite() || !(n.norm() > 0.5)) continue;
      geometry.point.push_back(x);
      geometry.normal.push_back(n.normalized());
    }
  } catch (const std::string&) {
  }
}

}  // namespace

std::vector<EntityGeometry> geometry_of(const std::vector<Entity>& entities, double scale) {
  std::vector<EntityGeometry> result(entities.size());
  for (std::size_t e = 0; e < entities.size(); ++e) {
    const Entity& entity = entities[e];
    if (entity.dimension > 2) continue;
    measure(entity, scale, result[e]);
    if (entity.dimension < 2) continue;
    sample(entity.number, scale, result[e]);
    std::vector<int> inner;
    gmsh::model::getAdjacencies(2, entity.number, result[e].volumes, inner);
  }
  return result;
}

}  // namespace tisserand::reducer

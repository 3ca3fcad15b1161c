// SPDX-License-Identifier: GPL-3.0-or-later
// Mapped meshes of plates, discs, cylinders and extrusions.
#include "reducer/sources/patches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "common/math/count.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;

/// Grid of nodes X(i, j), i = 0..n, j = 0..m; the normal of its elements is X_i x X_j.
struct Grid {
  int n = 0;
  int m = 0;
  std::function<Vector3d(int, int)> at;
};

/// Row of nodes along an edge of a grid that becomes a group.
struct GridEdge {
  std::string name;
  std::size_t grid = 0;
  bool along_i = true;  ///< i varies and j = fixed; or the reverse
  int fixed = 0;
};

struct Grids {
  std::vector<Grid> grids;
  std::vector<GridEdge> edges;
};

int count_from(double length, double size, const formats::ShellPatch& patch) {
  const double wanted = std::ceil(length / size * (1.0 - 1e-12));
  if (!(wanted <= 1e6))
    throw Error(fmt::format("'{}': size {:g} gives {:.3g} elements along one side", patch.name, size, wanted),
                patch.where, "use a larger size");
  return std::max(1, static_cast<int>(wanted));
}

/// Direction across the axis to angle 0: the given one, or the global axis most nearly normal to the axis.
Vector3d start_direction(const std::optional<Vector3d>& start, const Vector3d& axis) {
  int best = 0;
  for (const int k : {1, 2})
    if (std::abs(axis[k]) < std::abs(axis[best]) - 1e-9 * axis.norm()) best = k;
  const Vector3d wanted = start.value_or(Vector3d::Unit(best)), n = axis.normalized();
  return (wanted - wanted.dot(n) * n).normalized();
}

Grids grids_of(const formats::Plate& plate, const formats::ShellPatch& patch) {
  const auto& c = plate.corners;
  Grid grid;
  const auto side = [&](int a, int b) { return (c[a] - c[b]).norm(); };
  const bool counted = !patch.elements.empty();
  grid.n = counted ? patch.elements[0] : count_from(std::max(side(0, 1), side(3, 2)), patch.size, patch);
  grid.m = counted ? patch.elements[1] : count_from(std::max(side(0, 3), side(1, 2)), patch.size, patch);
  grid.at = [c, n = grid.n, m = grid.m](int i, int j) -> Vector3d {
    const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / m;
    return (1 - s) * (1 - t) * c[0] + s * (1 - t) * c[1] + s * t * c[2] + (1 - s) * t * c[3];
  };
  return {{grid},
          {{"edge1", 0, true, 0}, {"edge2", 0, false, grid.n}, {"edge3", 0, true, grid.m}, {"edge4", 0, false, 0}}};
}

/// Axes of circles: e1 to angle 0, e2 to 90 degrees, right-handed about the axis.
struct Circle {
  Vector3d center, e1, e2;
  Vector3d at(double radius, double angle) const {
    return center + radius * (std::cos(angle) * e1 + std::sin(angle) * e2);
  }
};

Circle circle_of(const Vector3d& center, const Vector3d& axis, const std::optional<Vector3d>& start) {
  const Vector3d e1 = start_direction(start, axis);
  return {center, e1, axis.normalized().cross(e1)};
}

/// Square core with corners at 0, 90, 180, 270 degrees on 0.6 of the radius, and rings around it.
Grids full_disc(const Circle& circle, double radius, int around, int rings) {
  const int side = around / 4;
  const auto corner = [circle, radius](int k) -> Vector3d {
    return circle.at(0.6 * radius, 0.5 * std::numbers::pi * k);
  };
  Grids result;
  result.grids.push_back({side, side, [corner, side](int i, int j) -> Vector3d {
                            const double s = static_cast<double>(i) / side, t = static_cast<double>(j) / side;
                            return (1 - s) * (1 - t) * corner(0) + s * (1 - t) * corner(1) + s * t * corner(2) +
                                   (1 - s) * t * corner(3);
                          }});
  result.grids.push_back({rings, around, [=](int i, int j) -> Vector3d {
                            const int k = (j / side) % 4;
                            const double s = static_cast<double>(j % side) / side;
                            const Vector3d inner = (1 - s) * corner(k) + s * corner(k + 1);
                            const double t = static_cast<double>(i) / rings;
                            return (1 - t) * inner + t * circle.at(radius, 2.0 * std::numbers::pi * j / around);
                          }});
  result.edges.push_back({"rim", 1, false, rings});
  return result;
}

Grids grids_of(const formats::Disc& disc, const formats::ShellPatch& patch) {
  const Circle circle = circle_of(disc.center, disc.normal, disc.start);
  const bool counted = !patch.elements.empty(), full = disc.inner_radius == 0.0;
  int around =
      counted ? patch.elements[0] : std::max(8, count_from(2.0 * std::numbers::pi * disc.radius, patch.size, patch));
  if (!counted && full) around = 4 * ((around + 3) / 4);
  const double width = full ? 0.4 * disc.radius : disc.radius - disc.inner_radius;
  const int rings = counted ? patch.elements[1] : count_from(width, patch.size, patch);
  if (full) return full_disc(circle, disc.radius, around, rings);
  const double inner = disc.inner_radius, outer = disc.radius;
  const Grid grid{rings, around, [=](int i, int j) -> Vector3d {
                    return circle.at(inner + (outer - inner) * i / rings,
                                     2.0 * std::numbers::pi * (j % around) / around);
                  }};
  return {{grid}, {{"rim", 0, false, rings}, {"hole", 0, false, 0}}};
}

Grids grids_of(const formats::Cylinder& cylinder, const formats::ShellPatch& patch) {
  const Vector3d axis = cylinder.to - cylinder.from;
  const Circle circle = circle_of(cylinder.from, axis, cylinder.start);
  const bool counted = !patch.elements.empty(), closed = cylinder.angle > 2.0 * std::numbers::pi * (1.0 - 1e-12);
  const double arc = cylinder.angle * std::max(cylinder.radius, cylinder.end_radius);
  const int n = counted ? patch.elements[0] : std::max(closed ? 8 : 1, count_from(arc, patch.size, patch));
  const double slant = std::hypot(axis.norm(), cylinder.end_radius - cylinder.radius);
  const int m = counted ? patch.elements[1] : count_from(slant, patch.size, patch);
  const Grid grid{n, m, [=](int i, int j) -> Vector3d {
                    const double t = static_cast<double>(j) / m;
                    const double radius = (1 - t) * cylinder.radius + t * cylinder.end_radius;
                    return circle.at(radius, cylinder.angle * (closed ? i % n : i) / n) + t * axis;
                  }};
  return {{grid}, {{"start", 0, true, 0}, {"end", 0, true, m}}};
}

/// x moved along the path, t in [0, 1].
Vector3d moved(const formats::Extrusion& extrusion, const Vector3d& x, double t) {
  if (const auto* along = std::get_if<Vector3d>(&extrusion.path)) return x + t * *along;
  const auto& arc = std::get<formats::ArcPath>(extrusion.path);
  return arc.through + Eigen::AngleAxisd(t * arc.angle, arc.axis.normalized()) * (x - arc.through);
}

double path_length(const formats::Extrusion& extrusion) {
  if (const auto* along = std::get_if<Vector3d>(&extrusion.path)) return along->norm();
  const auto& arc = std::get<formats::ArcPath>(extrusion.path);
  double radius = 0.0;
  for (const Vector3d& x : extrusion.section)
    radius = std::max(radius, (x - arc.through).cross(arc.axis.normalized()).norm());
  return radius * std::abs(arc.angle);
}

Grids grids_of(const formats::Extrusion& extrusion, const formats::ShellPatch& patch) {
  const bool counted = !patch.elements.empty();
  const int m = counted ? patch.elements[1] : count_from(path_length(extrusion), patch.size, patch);
  Grids result;
  for (std::size_t k = 0; k + 1 < extrusion.section.size(); ++k) {
    const Vector3d a = extrusion.section[k], b = extrusion.section[k + 1];
    const int n = counted ? patch.elements[0] : count_from((b - a).norm(), patch.size, patch);
    result.grids.push_back({n, m, [extrusion, a, b, n, m](int i, int j) -> Vector3d {
                              const double s = static_cast<double>(i) / n;
                              return moved(extrusion, (1 - s) * a + s * b, static_cast<double>(j) / m);
                            }});
    result.edges.push_back({"start", k, true, 0});
    result.edges.push_back({"end", k, true, m});
  }
  return result;
}

double shortest_edge(const Grid& grid) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const int i : {0, grid.n - 1})
    for (const int j : {0, grid.m - 1}) {
      const double a = (grid.at(i + 1, j) - grid.at(i, j)).norm(), b = (grid.at(i, j + 1) - grid.at(i, j)).norm();
      for (const double length : {a, b})
        if (length > 0.0) shortest = std::min(shortest, length);
    }
  return shortest;
}

/// Appends the cells of one grid; nodes(i, j) row by row.
class GridWriter {
 public:
  GridWriter(PatchMesh& mesh, const formats::ShellPatch& patch, std::size_t number, const Grid& grid)
      : mesh_(mesh), patch_(patch), grid_(grid) {
    for (int j = 0; j <= grid.m; ++j)
      for (int i = 0; i <= grid.n; ++i) {
        nodes_.push_back(mesh.nodes.at(grid.at(i, j)));
        if (mesh.label.size() == mesh.nodes.position().size()) continue;
        mesh.label.push_back(number == 0 ? fmt::format("{}[{},{}]", patch.name, i, j)
                                         : fmt::format("{}:{}[{},{}]", patch.name, number + 1, i, j));
      }
  }

  void faces() const {
    for (int j = 0; j < grid_.m; ++j)
      for (int i = 0; i < grid_.n; ++i) {
        const std::array<int, 4> quad{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
        if (patch_.cells == formats::Cells::quadrilaterals) {
          add(CellShape::quadrilateral4, {quad[0], quad[1], quad[2], quad[3]});
        } else {
          add(CellShape::triangle3, {quad[0], quad[1], quad[2]});
          add(CellShape::triangle3, {quad[0], quad[2], quad[3]});
        }
      }
  }

  void lines(const GridEdge& edge) const {
    const int count = edge.along_i ? grid_.n : grid_.m;
    for (int k = 0; k < count; ++k)
      add(CellShape::line2, {edge.along_i ? node(k, edge.fixed) : node(edge.fixed, k),
                             edge.along_i ? node(k + 1, edge.fixed) : node(edge.fixed, k + 1)});
  }

 private:
  int node(int i, int j) const {
    return nodes_[static_cast<std::size_t>(j) * static_cast<std::size_t>(grid_.n + 1) + static_cast<std::size_t>(i)];
  }

  /// Adds a cell. Coincident corners (a profile that touches the axis of its arc) make a triangle, or no cell.
  void add(CellShape shape, std::vector<int> corners) const {
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    const int dimension = form_of(shape).dimension;
    if (count_of(corners) < dimension + 1) return;
    if (dimension == 2 && corners.size() == 3) shape = CellShape::triangle3;
    auto& cells = mesh_.cells.cells[dimension];
    Cell cell;
    cell.shape = shape;
    cell.id = static_cast<long>(cells.size() - mesh_.cells.entities.back().first) + 1;
    std::copy(corners.begin(), corners.end(), cell.nodes.begin());
    cells.push_back(cell);
    ++mesh_.cells.entities.back().count;
  }

  PatchMesh& mesh_;
  const formats::ShellPatch& patch_;
  const Grid& grid_;
  std::vector<int> nodes_;
};

void open_entity(PatchMesh& mesh, int dimension, const std::string& name) {
  mesh.cells.entities.push_back({dimension, 0, name, mesh.cells.cells[dimension].size(), 0});
}

/// Appends a patch; edges of the same name ("start" of each segment of a profile) become one entity.
void append_patch(PatchMesh& mesh, const formats::ShellPatch& patch, const Grids& grids) {
  std::vector<GridWriter> writers;
  for (std::size_t k = 0; k < grids.grids.size(); ++k) writers.emplace_back(mesh, patch, k, grids.grids[k]);
  open_entity(mesh, 2, patch.name);
  for (const GridWriter& writer : writers) writer.faces();
  std::vector<std::string> done;
  for (const GridEdge& edge : grids.edges) {
    if (std::ranges::find(done, edge.name) != done.end()) continue;
    done.push_back(edge.name);
    open_entity(mesh, 1, patch.name + "/" + edge.name);
    for (const GridEdge& same : grids.edges)
      if (same.name == edge.name) writers[same.grid].lines(same);
  }
}

}  // namespace

PatchMesh mesh_patches(const formats::Part& part) {
  std::vector<Grids> all;
  double shortest = std::numeric_limits<double>::infinity(), cells = 0.0;
  for (const formats::ShellPatch& patch : part.patches) {
    all.push_back(std::visit([&patch](const auto& shape) { return grids_of(shape, patch); }, patch.shape));
    for (const Grid& grid : all.back().grids) {
      shortest = std::min(shortest, shortest_edge(grid));
      cells += static_cast<double>(grid.n) * grid.m;
    }
    if (cells > most_elements)
      throw Error(fmt::format("'{}': the part has {:.3g} elements up to this one, more than {:g}", patch.name, cells,
                              most_elements),
                  patch.where, "use larger elements");
  }
  PatchMesh mesh;
  mesh.nodes = MergedNodes(std::isfinite(shortest) ? 1e-6 * shortest : 1.0);
  for (std::size_t k = 0; k < all.size(); ++k) append_patch(mesh, part.patches[k], all[k]);
  mesh.cells.position = mesh.nodes.position();
  mesh.cells.node_id.assign(mesh.cells.position.size(), -1);
  return mesh;
}

}  // namespace tisserand::reducer

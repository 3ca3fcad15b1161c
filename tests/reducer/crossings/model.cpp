// SPDX-License-Identifier: GPL-3.0-or-later
// Grids that no symmetry maps on themselves, and what is tied to them.
#include "tests/reducer/crossings/model.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace tisserand::testing::crossings {
namespace {

using Eigen::Vector3d;

constexpr std::array<const char*, 9> body_names{"beams",      "quads",  "triangles",     "bricks",  "bricks20",
                                                "tetrahedra", "prisms", "skinned_frame", "laminate"};
constexpr std::array<const char*, 5> extra_names{"nothing", "mass", "bushing", "link", "offset"};
constexpr std::array<const char*, 4> boundary_names{"ends", "averaged_end", "bare", "one"};
constexpr std::array<const char*, 7> way_names{"modes",        "moments", "rubin",        "macneal",
                                               "krylov_schur", "lapack",  "block_lanczos"};
constexpr std::array<const char*, 6> change_names{"turned", "mirrored", "units", "renumbered", "far", "abaqus"};

bool is_solid(Body body) {
  return body == Body::bricks || body == Body::bricks20 || body == Body::tetrahedra || body == Body::prisms;
}

/// Nodes of a grid of nx x ny x nz cells (nz = 0: a sheet), bent, tapered, sheared.
class Grid {
 public:
  Grid(int nx, int ny, int nz, PartModel& model) : nx_(nx), ny_(ny), nz_(nz) {
    for (int i = 0; i <= nx; ++i)
      for (int j = 0; j <= ny; ++j)
        for (int k = 0; k <= nz; ++k) {
          const double x = 1.0 * i / nx, y = 0.31 * (1.0 - 0.25 * x) * (1.0 * j / std::max(ny, 1) - 0.4);
          const double z = 0.08 * x * x + (nz > 0 ? 0.17 * (1.0 + 0.2 * x) * (1.0 * k / nz - 0.5) : 0.0);
          model.nodes.emplace_back(x + 0.1 * z, y, z);
        }
  }
  int at(int i, int j, int k) const { return (i * (ny_ + 1) + j) * (nz_ + 1) + k; }
  std::vector<int> section(int i) const {
    std::vector<int> nodes;
    for (int j = 0; j <= ny_; ++j)
      for (int k = 0; k <= nz_; ++k) nodes.push_back(at(i, j, k));
    return nodes;
  }
  /// Two sections of a sheet, whose one is a line and defines no rotation about it.
  std::vector<int> averaged(int i) const {
    std::vector<int> nodes = section(i);
    if (nz_ > 0) return nodes;
    const std::vector<int> more = section(i < nx_ ? i + 1 : i - 1);
    nodes.insert(nodes.end(), more.begin(), more.end());
    return nodes;
  }
  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int nz() const { return nz_; }

 private:
  int nx_, ny_, nz_;
};

std::array<int, 8> brick(const Grid& g, int i, int j, int k) {
  return {g.at(i, j, k),     g.at(i + 1, j, k),     g.at(i + 1, j + 1, k),     g.at(i, j + 1, k),
          g.at(i, j, k + 1), g.at(i + 1, j, k + 1), g.at(i + 1, j + 1, k + 1), g.at(i, j + 1, k + 1)};
}

/// With nodes in the middle of the edges, in the order of Nastran.
Element quadratic(const std::array<int, 8>& corner, std::map<std::pair<int, int>, int>& middle, PartModel& model) {
  static constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5},
                                       {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};
  Element element{Shape::brick20, {corner.begin(), corner.end()}};
  for (const auto& [a, b] : edges) {
    const auto [place, is_new] = middle.try_emplace(std::minmax(corner[a], corner[b]), 0);
    if (is_new) {
      place->second = static_cast<int>(model.nodes.size());
      model.nodes.push_back(0.5 * (model.nodes[corner[a]] + model.nodes[corner[b]]));
    }
    element.nodes.push_back(place->second);
  }
  return element;
}

void fill_solids(Body body, const Grid& g, PartModel& model) {
  static constexpr int tetrahedra[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                           {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  std::map<std::pair<int, int>, int> middle;
  for (int i = 0; i < g.nx(); ++i)
    for (int j = 0; j < g.ny(); ++j)
      for (int k = 0; k < g.nz(); ++k) {
        const std::array<int, 8> c = brick(g, i, j, k);
        if (body == Body::bricks) model.elements.push_back({Shape::brick, {c.begin(), c.end()}});
        if (body == Body::bricks20) model.elements.push_back(quadratic(c, middle, model));
        if (body == Body::prisms) {
          model.elements.push_back({Shape::prism, {c[0], c[1], c[2], c[4], c[5], c[6]}});
          model.elements.push_back({Shape::prism, {c[0], c[2], c[3], c[4], c[6], c[7]}});
        }
        if (body == Body::tetrahedra)
          for (const auto& t : tetrahedra)
            model.elements.push_back({Shape::tetrahedron, {c[t[0]], c[t[1]], c[t[2]], c[t[3]]}});
      }
}

void fill_shells(Body body, const Grid& g, PartModel& model) {
  for (int i = 0; i < g.nx(); ++i)
    for (int j = 0; j < g.ny(); ++j) {
      const int a = g.at(i, j, 0), b = g.at(i + 1, j, 0), c = g.at(i + 1, j + 1, 0), d = g.at(i, j + 1, 0);
      if (body == Body::triangles) {
        model.elements.push_back({Shape::triangle, {a, b, c}});
        model.elements.push_back({Shape::triangle, {a, c, d}});
      } else {
        model.elements.push_back({Shape::quad, {a, b, c, d}});
      }
    }
  if (body == Body::skinned_frame)
    for (int i = 0; i < g.nx(); ++i) model.elements.push_back({Shape::bar, {g.at(i, 0, 0), g.at(i + 1, 0, 0)}});
}

Grid grid_of(Body body, PartModel& model) {
  if (body == Body::bricks20) return Grid(3, 1, 1, model);
  if (body == Body::beams) return Grid(8, 0, 0, model);
  return is_solid(body) ? Grid(6, 2, 2, model) : Grid(8, 2, 0, model);
}

/// A node beside the middle of some, which leads or follows them.
int add_reference(const std::vector<int>& nodes, bool is_rigid, bool with_rotations, PartModel& model) {
  Vector3d middle = Vector3d::Zero();
  for (const int node : nodes) middle += model.nodes[node] / static_cast<double>(nodes.size());
  const int reference = static_cast<int>(model.nodes.size());
  model.nodes.push_back(middle + Vector3d(0.01, 0.02, -0.015));
  model.spiders.push_back({is_rigid, reference, nodes, with_rotations});
  return reference;
}

/// A node with six coordinates which moves as a section does.
int attachment(const Cell& cell, const Grid& g, int i, PartModel& model) {
  if (cell.body != Body::beams) return add_reference(g.averaged(i), false, false, model);
  const int arm = static_cast<int>(model.nodes.size());
  model.nodes.push_back(model.nodes[g.at(i, 0, 0)] + Vector3d(0.01, 0.02, -0.015));
  model.spiders.push_back({true, g.at(i, 0, 0), {arm}, true});
  return arm;
}

void add_boundary(const Cell& cell, const Grid& g, PartModel& model) {
  const bool is_line = cell.body == Body::beams;
  if (cell.boundary == Boundary::bare) {
    model.is_bare = true;
    model.boundary = {g.at(0, 0, 0), g.at(g.nx(), 0, g.nz()), g.at(g.nx() / 2, g.ny(), 0)};
    return;
  }
  const auto end = [&](int i, bool is_rigid) {
    if (is_line) return g.at(i, 0, 0);
    return is_rigid ? add_reference(g.section(i), true, !is_solid(cell.body), model)
                    : add_reference(g.averaged(i), false, false, model);
  };
  model.boundary = {end(0, true)};
  if (cell.boundary == Boundary::ends) model.boundary.push_back(end(g.nx(), true));
  if (cell.boundary == Boundary::averaged_end)
    model.boundary.push_back(is_line ? attachment(cell, g, g.nx() - 1, model) : end(g.nx(), false));
}

}  // namespace

std::string name_of(const Cell& cell) {
  const auto text = [](const auto& names, auto value) { return std::string(names[static_cast<std::size_t>(value)]); };
  return text(body_names, cell.body) + ", " + text(extra_names, cell.extra) + ", " +
         text(boundary_names, cell.boundary) + ", " + text(way_names, cell.way) + ", " +
         text(change_names, cell.change);
}

bool is_sensible(const Cell& cell) {
  if (cell.extra == Extra::offset && is_solid(cell.body)) return false;
  // The arm that stands for an average follows a node; it cannot be one of the boundary.
  if (cell.boundary == Boundary::averaged_end && cell.body == Body::beams) return false;
  const bool is_plain = is_solid(cell.body) || cell.body == Body::quads || cell.body == Body::triangles;
  return cell.change != Change::abaqus || (is_plain && cell.extra == Extra::nothing);
}

Eigen::Matrix3d PartModel::mass_inertia() {
  return (Eigen::Matrix3d() << 2e-3, 2e-4, -1e-4, 2e-4, 3e-3, 3e-4, -1e-4, 3e-4, 4e-3).finished();
}

PartModel part_model(const Cell& cell) {
  PartModel model;
  const Grid g = grid_of(cell.body, model);
  model.is_laminate = cell.body == Body::laminate;
  if (model.is_laminate) model.turn = 30.0;
  if (cell.body == Body::beams) {
    for (int i = 0; i <= g.nx(); ++i) model.nodes[i] += Vector3d(0.0, 0.12 * i * i / 64.0, 0.05 * i / 8.0);
    for (int i = 0; i < g.nx(); ++i) model.elements.push_back({Shape::bar, {i, i + 1}});
  } else if (is_solid(cell.body)) {
    fill_solids(cell.body, g, model);
  } else {
    fill_shells(cell.body, g, model);
  }
  add_boundary(cell, g, model);
  model.has_own_second_order = cell.boundary != Boundary::averaged_end;
  const int middle = g.nx() / 2;
  model.loaded = g.at(g.nx() - 1, g.ny(), g.nz());
  if (cell.extra == Extra::mass) model.mass = attachment(cell, g, middle, model);
  if (cell.extra == Extra::bushing) {
    const int first = attachment(cell, g, 1, model);
    model.bushing = {first, attachment(cell, g, g.nx() - 2, model)};
  }
  if (cell.extra == Extra::link) model.link = {g.at(1, 0, 0), g.at(g.nx() - 1, g.ny() / 2, g.nz())};
  if (cell.extra == Extra::offset) {
    model.bar_offset = {0.0, 0.01, -0.02};
    model.shell_offset = 0.004;
  }
  return model;
}

}  // namespace tisserand::testing::crossings

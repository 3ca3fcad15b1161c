// SPDX-License-Identifier: GPL-3.0-or-later
// Slopes of the curved surface and bows of free edges.
#include "reducer/mesh_error/surround.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "reducer/elements/shell/geometry.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double largest_turn = 0.53;  ///< of edges that count as curved: 30 degrees

Eigen::Matrix3d shell_axes(const Mesh& mesh, const ShellElement& shell) {
  return shell.corners() == 3 ? shell_geometry<3>(mesh, shell).R_PE : shell_geometry<4>(mesh, shell).R_PE;
}

/// Shells with their patches and axes.
struct Shells {
  const Mesh& mesh;
  const StressPatches& patches;
  std::vector<Eigen::Matrix3d> axes;

  int patch(int shell, int corner) const { return patches.of_corner[patches.first[shell] + corner]; }
  Vector3d corner(int shell, int k) const { return mesh.position.col(mesh.shells[shell].nodes[k]); }
  bool at_border(int patch_index) const { return patches.patch[patch_index].source.front() != patch_index; }
};

/// Mean normals of patches, on the side of their first shell's normal.
Eigen::Matrix3Xd normals_of_patches(const Shells& all) {
  Eigen::Matrix3Xd normal = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(all.patches.patch.size()));
  for (int s = 0; s < std::ssize(all.axes); ++s)
    for (int k = 0; k < all.mesh.shells[s].corners(); ++k) {
      const int p = all.patch(s, k), first = all.patches.patch[p].elements.front();
      const double sign = std::copysign(1.0, all.axes[s].col(2).dot(all.axes[first].col(2)));
      normal.col(p) += sign * angle_at_corner(all.mesh, all.mesh.shells[s], k) * all.axes[s].col(2);
    }
  normal.colwise().normalize();
  return normal;
}

void set_slopes(const Shells& all, const Eigen::Matrix3Xd& normal, int s, ShellSurround& around) {
  const int count = all.mesh.shells[s].corners();
  const Eigen::Matrix3d& axes = all.axes[s];
  for (int k = 0; k < count; ++k) {
    const Vector3d n = axes.transpose() * normal.col(all.patch(s, k));
    around.slope.col(k) = -n.head<2>() / n.z();
  }
  const Eigen::Matrix<double, 2, 4> inside = around.slope;
  for (int k = 0; k < count; ++k) {
    if (!all.at_border(all.patch(s, k))) continue;
    for (const int other : {(k + 1) % count, (k + count - 1) % count}) {
      if (all.at_border(all.patch(s, other))) continue;
      const Vector2d along = (axes.transpose() * (all.corner(s, other) - all.corner(s, k))).head<2>().normalized();
      around.slope.col(k) -= along * along.dot(inside.col(other) + around.slope.col(k));
    }
  }
}

/// Gradient of the slopes by least squares over the corners, times √area.
void set_turn(const Shells& all, int s, ShellSurround& around) {
  const int count = all.mesh.shells[s].corners();
  Eigen::Matrix<double, 2, 4> x = Eigen::Matrix<double, 2, 4>::Zero();
  Vector3d middle = Vector3d::Zero();
  for (int k = 0; k < count; ++k) middle += all.corner(s, k) / count;
  for (int k = 0; k < count; ++k) x.col(k) = (all.axes[s].transpose() * (all.corner(s, k) - middle)).head<2>();
  const Eigen::Matrix2d spread = x * x.transpose();
  const double size = std::pow(spread.determinant(), 0.25);  // side of a square of equal spread
  const Eigen::Matrix2d gradient = around.slope * x.transpose() * spread.inverse();
  around.turn = 0.5 * size * (gradient + gradient.transpose());
}

/// Edge that belongs to one shell only.
struct FreeEdge {
  int shell = 0;
  int corner = 0;
};

std::vector<FreeEdge> free_edges(const Mesh& mesh, const StressPatches& patches) {
  std::map<std::pair<int, int>, int> users;
  const auto key = [&](int s, int k) {
    const ShellElement& shell = mesh.shells[s];
    return std::minmax({shell.nodes[k], shell.nodes[(k + 1) % shell.corners()]});
  };
  std::vector<FreeEdge> ending, result;
  for (int s = 0; s < std::ssize(mesh.shells); ++s)
    for (int k = 0; k < mesh.shells[s].corners(); ++k)
      if (patches.ending[s][k]) {
        ++users[key(s, k)];
        ending.push_back({s, k});
      }
  for (const FreeEdge& edge : ending)
    if (users[key(edge.shell, edge.corner)] == 1) result.push_back(edge);
  return result;
}

/// Sets the bows from the turn of the border at each end of a free edge, positive where the sheet is convex. A free
/// edge beyond an end belongs to the same patch there.
void set_bows(const Shells& all, std::vector<ShellSurround>& around) {
  struct End {
    FreeEdge edge;
    int patch = 0;
    Vector3d along, outwards;  ///< from the end into the edge; out of the sheet
  };
  std::map<int, std::vector<End>> at;  // key: patch
  for (const FreeEdge& edge : free_edges(all.mesh, all.patches)) {
    const int next = (edge.corner + 1) % all.mesh.shells[edge.shell].corners();
    const Vector3d d = (all.corner(edge.shell, next) - all.corner(edge.shell, edge.corner)).normalized();
    const Vector3d outwards = d.cross(all.axes[edge.shell].col(2)).normalized();
    for (const auto& [corner, along] : {std::pair{edge.corner, d}, std::pair{next, Vector3d(-d)}}) {
      const int p = all.patch(edge.shell, corner);
      at[p].push_back({edge, p, along, outwards});
    }
  }
  for (const auto& [patch, ends] : at) {
    if (ends.size() != 2) continue;
    const double turn = -std::asin(std::clamp(ends[1].along.dot(ends[0].outwards), -1.0, 1.0));
    if (std::abs(turn) > largest_turn || ends[0].along.dot(ends[1].along) > 0.0) continue;
    for (const End& end : ends) {
      const int next = (end.edge.corner + 1) % all.mesh.shells[end.edge.shell].corners();
      const double length = (all.corner(end.edge.shell, next) - all.corner(end.edge.shell, end.edge.corner)).norm();
      around[end.edge.shell].bow[end.edge.corner] += 0.5 * turn * length / 12.0;
    }
  }
}

}  // namespace

std::vector<ShellSurround> surroundings(const Mesh& mesh, const StressPatches& patches) {
  Shells all{mesh, patches, {}};
  for (const ShellElement& shell : mesh.shells) all.axes.push_back(shell_axes(mesh, shell));
  const Eigen::Matrix3Xd normal = normals_of_patches(all);
  std::vector<ShellSurround> around(mesh.shells.size());
  for (int s = 0; s < std::ssize(mesh.shells); ++s) {
    around[s].ending = patches.ending[s];
    set_slopes(all, normal, s, around[s]);
    set_turn(all, s, around[s]);
  }
  set_bows(all, around);
  return around;
}

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of shape of shell elements, reported with their measures before any matrix is made.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/shell/geometry.hpp"

namespace tisserand::reducer {
namespace {

constexpr double least_angle_deg = 1.0;  ///< error below it, or above 180° minus it
constexpr double sharp_angle_deg = 20.0;
constexpr double largest_aspect = 20.0;
constexpr double warned_warp = 0.05;
constexpr double largest_warp = 0.3;
constexpr double collapsed_ratio = 1e-6;

std::string node_name(const Mesh& mesh, int node) {
  const auto i = static_cast<std::size_t>(node);
  return i < mesh.node_label.size() ? mesh.node_label[i] : fmt::format("node {}", node);
}

struct Edges {
  double shortest = 0.0, longest = 0.0;
  int first = 0, second = 0;  ///< nodes of the shortest
};

Edges edges_of(const Mesh& mesh, const ShellElement& shell) {
  Edges edges;
  const int corners = shell.corners();
  for (int i = 0; i < corners; ++i) {
    const int a = shell.nodes[i], b = shell.nodes[(i + 1) % corners];
    const double length = (mesh.position.col(b) - mesh.position.col(a)).norm();
    if (i == 0 || !(length >= edges.shortest)) edges = {length, edges.longest, a, b};
    edges.longest = std::max(edges.longest, length);
  }
  return edges;
}

/// Checks the inner angles of the projected polygon, 0 to 360 degrees; a corner that points inwards has more than 180.
template <int Corners>
void check_angles(const Mesh& mesh, const ShellElement& shell, const ShellGeometry<Corners>& geometry,
                  ShapeFindings& findings) {
  for (int i = 0; i < Corners; ++i) {
    const Eigen::Vector2d next = geometry.corner.col((i + 1) % Corners) - geometry.corner.col(i);
    const Eigen::Vector2d last = geometry.corner.col((i + Corners - 1) % Corners) - geometry.corner.col(i);
    double angle = std::atan2(next.x() * last.y() - next.y() * last.x(), next.dot(last)) * 180.0 / std::numbers::pi;
    if (angle < 0.0) angle += 360.0;
    const std::string at = node_name(mesh, shell.nodes[i]);
    if (angle >= 180.0)
      findings.errors.push_back(
          fmt::format("inner angle {:.1f}° at {}: the element is concave or its nodes cross", angle, at));
    else if (angle < least_angle_deg || angle > 180.0 - least_angle_deg)
      findings.errors.push_back(fmt::format("inner angle {:.2f}° at {} (allowed: {:g}° to {:g}°)", angle, at,
                                            least_angle_deg, 180.0 - least_angle_deg));
    else if (angle < sharp_angle_deg || angle > 180.0 - sharp_angle_deg)
      findings.warnings.push_back(fmt::format("inner angle {:.1f}° at {}", angle, at));
  }
}

template <int Corners>
void check_warp(const ShellGeometry<Corners>& geometry, ShapeFindings& findings) {
  const double warp = geometry.height.cwiseAbs().maxCoeff() / std::sqrt(geometry.area);
  if (warp > largest_warp)
    findings.errors.push_back(fmt::format(
        "warped: corners are out of its plane by {:.3g} of the element's size (allowed: {:g})", warp, largest_warp));
  else if (warp > warned_warp)
    findings.warnings.push_back(
        fmt::format("warped: corners are out of its plane by {:.3g} of the element's size", warp));
}

/// Checks the material direction: within 1e-3 rad of the normal it has no meaningful projection.
void check_material_axis(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal, ShapeFindings& findings) {
  const double length = direction.norm();
  if (length > 0.0 && (direction - normal * normal.dot(direction)).norm() < 1e-3 * length)
    findings.errors.push_back(fmt::format("material direction ({:g}, {:g}, {:g}) is normal to the element",
                                          direction.x(), direction.y(), direction.z()));
}

template <int Corners>
void check(const Mesh& mesh, const ShellElement& shell, const Edges& edges, ShapeFindings& findings) {
  const ShellGeometry<Corners> geometry = shell_geometry<Corners>(mesh, shell);
  if (!(geometry.area > collapsed_ratio * edges.longest * edges.longest)) {
    findings.errors.push_back(
        fmt::format("collapsed: area {:.3g} with a longest edge of {:.3g}", geometry.area, edges.longest));
    return;
  }
  check_angles(mesh, shell, geometry, findings);
  check_warp(geometry, findings);
  check_material_axis(shell.material_x, geometry.R_PE.col(2), findings);
  if (edges.longest > largest_aspect * edges.shortest)
    findings.warnings.push_back(fmt::format("aspect ratio {:.3g}: edges from {:.3g} to {:.3g}",
                                            edges.longest / edges.shortest, edges.shortest, edges.longest));
}

}  // namespace

void check_shape(const Mesh& mesh, const ShellElement& shell, ShapeFindings& findings) {
  const Edges edges = edges_of(mesh, shell);
  if (!std::isfinite(edges.longest) || !std::isfinite(edges.shortest)) {
    findings.errors.push_back("coordinates that are not finite");
  } else if (!(edges.shortest > collapsed_ratio * edges.longest)) {
    findings.errors.push_back(fmt::format("collapsed: edge {:.3g} long between {} and {}", edges.shortest,
                                          node_name(mesh, edges.first), node_name(mesh, edges.second)));
  } else if (shell.corners() == 3) {
    check<3>(mesh, shell, edges, findings);
  } else {
    check<4>(mesh, shell, edges, findings);
  }
}

}  // namespace tisserand::reducer

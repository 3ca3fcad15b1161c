// SPDX-License-Identifier: GPL-3.0-or-later
// Axes and projected corners of shell elements.
#include "reducer/elements/shell/geometry.hpp"

#include <Eigen/Geometry>

namespace tisserand::reducer {
namespace {

/// x axis: material direction projected on the plane of `normal`; the first edge if it is zero or nearly normal.
Eigen::Vector3d in_plane_axis(const Eigen::Vector3d& direction, const Eigen::Vector3d& edge,
                              const Eigen::Vector3d& normal) {
  const Eigen::Vector3d projected = direction - normal * normal.dot(direction);
  if (projected.norm() > 1e-6 * direction.norm()) return projected.normalized();
  return (edge - normal * normal.dot(edge)).normalized();
}

}  // namespace

template <int Corners>
ShellGeometry<Corners> shell_geometry(const Mesh& mesh, const ShellElement& shell) {
  Eigen::Matrix<double, 3, Corners> X;
  for (int i = 0; i < Corners; ++i) X.col(i) = mesh.position.col(shell.nodes[i]);
  const Eigen::Vector3d centre = X.rowwise().mean();
  X.colwise() -= centre;
  const Eigen::Vector3d twice_area =
      Corners == 3 ? Eigen::Vector3d(X.col(1) - X.col(0)).cross(Eigen::Vector3d(X.col(2) - X.col(0)))
                   : Eigen::Vector3d(X.col(2) - X.col(0)).cross(Eigen::Vector3d(X.col(Corners - 1) - X.col(1)));
  ShellGeometry<Corners> geometry;
  geometry.area = 0.5 * twice_area.norm();
  const Eigen::Vector3d normal = twice_area / (2.0 * geometry.area);
  geometry.R_PE.col(0) = in_plane_axis(shell.material_x, X.col(1) - X.col(0), normal);
  geometry.R_PE.col(1) = normal.cross(geometry.R_PE.col(0));
  geometry.R_PE.col(2) = normal;
  geometry.corner = geometry.R_PE.template leftCols<2>().transpose() * X;
  if constexpr (Corners == 3)
    geometry.height.setZero();
  else
    geometry.height = X.transpose() * normal;
  return geometry;
}

template ShellGeometry<3> shell_geometry<3>(const Mesh&, const ShellElement&);
template ShellGeometry<4> shell_geometry<4>(const Mesh&, const ShellElement&);

BilinearShape bilinear_shape(double xi, double eta) {
  const double a = 1.0 - xi, b = 1.0 + xi, c = 1.0 - eta, d = 1.0 + eta;
  BilinearShape shape;
  shape.N << 0.25 * a * c, 0.25 * b * c, 0.25 * b * d, 0.25 * a * d;
  shape.slope << -0.25 * c, 0.25 * c, 0.25 * d, -0.25 * d, -0.25 * a, -0.25 * b, 0.25 * b, 0.25 * a;
  return shape;
}

}  // namespace tisserand::reducer

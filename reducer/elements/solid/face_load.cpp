// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure on faces of solids and shells; line loads on their edges.
#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include "reducer/elements/element_loads.hpp"
#include "reducer/elements/solid/quadrature.hpp"
#include "reducer/elements/solid/shapes.hpp"

namespace tisserand::reducer {
namespace {

/// Values and slopes of the shape functions of a face with `count` nodes at a point; the third coordinate is unused.
std::array<Jet, 8> face_functions(int count, const NaturalPoint& at) {
  const auto x = natural_jets(at);
  std::array<Jet, 8> N{};
  if (count == 3 || count == 6) {
    const std::array<Jet, 3> L{1.0 - (x[0] + x[1]), x[0], x[1]};
    for (std::size_t i = 0; i < 3; ++i) {
      N[i] = count == 3 ? L[i] : L[i] * (2.0 * L[i] - Jet{1.0, {}});
      if (count == 6) N[3 + i] = 4.0 * (L[i] * L[(i + 1) % 3]);
    }
    return N;
  }
  constexpr std::array<std::array<double, 2>, 8> nodes{
      {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    Jet product{i < 4 ? 0.25 : 0.5, {}}, sum{-1.0, {}};
    for (std::size_t k = 0; k < 2; ++k) {
      product = product * (nodes[i][k] == 0.0 ? 1.0 - x[k] * x[k] : 1.0 + nodes[i][k] * x[k]);
      sum = sum + nodes[i][k] * x[k];
    }
    N[i] = i < 4 && count == 8 ? product * sum : product;
  }
  return N;
}

void add_point(const Mesh& mesh, const FacePressure& face, const NaturalPoint& at, double weight,
               Eigen::Matrix3Xd& load) {
  const std::array<Jet, 8> N = face_functions(face.count, at);
  Eigen::Vector3d along_r = Eigen::Vector3d::Zero(), along_s = along_r;
  for (std::size_t i = 0; i < static_cast<std::size_t>(face.count); ++i) {
    along_r += N[i].slope[0] * mesh.position.col(face.nodes[i]);
    along_s += N[i].slope[1] * mesh.position.col(face.nodes[i]);
  }
  const Eigen::Vector3d force = -face.pressure * weight * along_r.cross(along_s);
  for (int i = 0; i < face.count; ++i) load.col(i) += N[i].value * force;
}

}  // namespace

Eigen::Matrix3Xd face_pressure_load(const Mesh& mesh, const FacePressure& face) {
  Eigen::Matrix3Xd load = Eigen::Matrix3Xd::Zero(3, face.count);
  if (face.count == 3 || face.count == 6) {
    for (const TrianglePoint& point : triangle7) add_point(mesh, face, {point.r, point.s, 0.0}, point.weight, load);
    return load;
  }
  for (const GaussPoint& a : gauss3)
    for (const GaussPoint& b : gauss3) add_point(mesh, face, {a.at, b.at, 0.0}, a.weight * b.weight, load);
  return load;
}

Eigen::Matrix3Xd shell_pressure_load(const Mesh& mesh, const ShellElement& shell, double pressure) {
  FacePressure face;
  face.count = shell.corners();
  std::copy_n(shell.nodes.begin(), face.count, face.nodes.begin());
  face.pressure = pressure;
  return face_pressure_load(mesh, face);
}

Eigen::Matrix3Xd edge_line_load(const Mesh& mesh, const EdgeLineLoad& edge) {
  Eigen::Matrix3Xd load = Eigen::Matrix3Xd::Zero(3, edge.count);
  for (const GaussPoint& point : gauss3) {
    const double x = point.at;
    Eigen::Vector3d N(0.5 * (1.0 - x), 0.5 * (1.0 + x), 0.0), slope(-0.5, 0.5, 0.0);
    if (edge.count == 3) {
      N << 0.5 * x * (x - 1.0), 0.5 * x * (x + 1.0), 1.0 - x * x;
      slope << x - 0.5, x + 0.5, -2.0 * x;
    }
    Eigen::Vector3d tangent = Eigen::Vector3d::Zero();
    for (int i = 0; i < edge.count; ++i) tangent += slope[i] * mesh.position.col(edge.nodes[i]);
    for (int i = 0; i < edge.count; ++i) load.col(i) += N[i] * point.weight * tangent.norm() * edge.force;
  }
  return load;
}

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Networks of walls: potentials of torsion and shear at the nodes, and integrals along the walls.
#include "formats/sections/walls.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace tisserand::formats {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

struct Wall {
  std::size_t from = 0, to = 0;  ///< indices of nodes
  double length = 0.0, thickness = 0.0;
  Vector2d direction = Vector2d::Zero();
};

struct Network {
  std::vector<Vector2d> nodes;
  std::vector<Wall> walls;
};

double extent(const std::vector<WallLine>& lines) {
  double size = 0.0;
  for (const WallLine& line : lines)
    for (const Vector2d& p : line.points) size = std::max(size, (p - lines[0].points[0]).cwiseAbs().maxCoeff());
  return size;
}

/// Network of the walls. Points closer than 1e-6 of the extent are one node.
Network network_of(const std::vector<WallLine>& lines) {
  Network network;
  const double tolerance = 1e-6 * extent(lines);
  const auto node_at = [&](const Vector2d& p) {
    for (std::size_t i = 0; i < network.nodes.size(); ++i)
      if ((network.nodes[i] - p).norm() <= tolerance) return i;
    network.nodes.push_back(p);
    return network.nodes.size() - 1;
  };
  for (const WallLine& line : lines)
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      Wall wall{node_at(line.points[i]), node_at(line.points[i + 1]), 0.0, line.thickness, Vector2d::Zero()};
      const Vector2d along = network.nodes[wall.to] - network.nodes[wall.from];
      wall.length = along.norm();
      wall.direction = wall.length > 0.0 ? Vector2d(along / wall.length) : Vector2d::Zero();
      network.walls.push_back(wall);
    }
  return network;
}

bool connected(const Network& network) {
  std::vector<std::size_t> parent(network.nodes.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&parent](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const Wall& wall : network.walls) parent[root(wall.from)] = root(wall.to);
  return std::all_of(parent.begin(), parent.end(), [&](std::size_t i) { return root(i) == root(0); });
}

/// Second moments ∫t x xᵀ ds along the middle lines.
Matrix2d line_moments(const Network& network) {
  Matrix2d Q = Matrix2d::Zero();
  for (const Wall& wall : network.walls) {
    const Vector2d &a = network.nodes[wall.from], &b = network.nodes[wall.to];
    const Matrix2d ab = a * b.transpose();
    Q += wall.thickness * wall.length / 6.0 * (2.0 * a * a.transpose() + 2.0 * b * b.transpose() + ab + ab.transpose());
  }
  return Q;
}

/// Moves the origin to the centroid, and returns the area.
double move_to_centroid(Network& network, Vector2d& centroid) {
  double area = 0.0;
  centroid.setZero();
  for (const Wall& wall : network.walls) {
    area += wall.thickness * wall.length;
    centroid += 0.5 * wall.thickness * wall.length * (network.nodes[wall.from] + network.nodes[wall.to]);
  }
  centroid /= area;
  for (Vector2d& node : network.nodes) node -= centroid;
  return area;
}

/// Signed distance h = y z' − z y' of a wall's line from the centroid.
double arm(const Network& network, const Wall& wall) {
  const Vector2d& p = network.nodes[wall.from];
  return p.x() * wall.direction.y() - p.y() * wall.direction.x();
}

/// Potentials at the nodes in columns: ω, ψ_y, ψ_z. ω has mean 0.
using Potentials = Eigen::Matrix<double, Eigen::Dynamic, 3>;

Potentials solve(const Network& network) {
  const Eigen::Index n = static_cast<Eigen::Index>(network.nodes.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  Potentials load = Potentials::Zero(n, 3);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(n);
  for (const Wall& wall : network.walls) {
    const Eigen::Index a = static_cast<Eigen::Index>(wall.from), b = static_cast<Eigen::Index>(wall.to);
    const double k = wall.thickness / wall.length, m = wall.thickness * wall.length / 6.0;
    K(a, a) += k, K(b, b) += k, K(a, b) -= k, K(b, a) -= k;
    const double flow = wall.thickness * arm(network, wall);
    load(a, 0) += flow;
    load(b, 0) -= flow;
    load.row(a).tail<2>() += m * (2.0 * network.nodes[wall.from] + network.nodes[wall.to]).transpose();
    load.row(b).tail<2>() += m * (network.nodes[wall.from] + 2.0 * network.nodes[wall.to]).transpose();
    area[a] += 3.0 * m, area[b] += 3.0 * m;
  }
  const double unit = K.diagonal().maxCoeff();  // Σ area u = 0 determines the free constant
  K += unit / area.squaredNorm() * area * area.transpose();
  Potentials u = K.ldlt().solve(load);
  const Eigen::RowVector3d mean = area.transpose() * u / area.sum();
  u.rowwise() -= mean;
  return u;
}

/// Integral ∫t x ω ds.
Vector2d warping_moments(const Network& network, const Potentials& u) {
  Vector2d sum = Vector2d::Zero();
  for (const Wall& wall : network.walls) {
    const Vector2d &a = network.nodes[wall.from], &b = network.nodes[wall.to];
    const double ua = u(static_cast<Eigen::Index>(wall.from), 0), ub = u(static_cast<Eigen::Index>(wall.to), 0);
    sum += wall.thickness * wall.length / 6.0 * (a * (2.0 * ua + ub) + b * (ua + 2.0 * ub));
  }
  return sum;
}

double torsion_constant(const Network& network, const Potentials& u) {
  double J = 0.0;
  for (const Wall& wall : network.walls) {
    const double slope =
        (u(static_cast<Eigen::Index>(wall.to), 0) - u(static_cast<Eigen::Index>(wall.from), 0)) / wall.length;
    J += wall.thickness * wall.length * std::pow(slope + arm(network, wall), 2) +
         wall.length * std::pow(wall.thickness, 3) / 3.0;
  }
  return J;
}

/// Integral ∫t ψ_i' ψ_j' ds = ∫t x_i ψ_j ds, by the values at nodes and by −ψ'' = x between them, with x linear. The
/// energy of the latter is length³/45 for unit values at the same end, 7 length³/360 at opposite ends.
Matrix2d shear_energies(const Network& network, const Potentials& u) {
  Matrix2d E = Matrix2d::Zero();
  for (const Wall& wall : network.walls) {
    const Vector2d &a = network.nodes[wall.from], &b = network.nodes[wall.to];
    const Vector2d difference = (u.row(wall.to).tail<2>() - u.row(wall.from).tail<2>()).transpose();
    const Matrix2d ab = a * b.transpose();
    E += wall.thickness / wall.length * difference * difference.transpose();
    E += wall.thickness * std::pow(wall.length, 3) *
         ((a * a.transpose() + b * b.transpose()) / 45.0 + 7.0 / 360.0 * (ab + ab.transpose()));
  }
  return E;
}

/// Integral ∫t ω_s² ds, ω_s = ω − z_s y + y_s z.
double warping_constant(const Network& network, const Potentials& u, const Vector2d& center) {
  double sum = 0.0;
  const auto at = [&](std::size_t node) {
    const Vector2d& p = network.nodes[node];
    return u(static_cast<Eigen::Index>(node), 0) - center.y() * p.x() + center.x() * p.y();
  };
  for (const Wall& wall : network.walls) {
    const double a = at(wall.from), b = at(wall.to);
    sum += wall.thickness * wall.length / 3.0 * (a * a + a * b + b * b);
  }
  return sum;
}

}  // namespace

std::optional<std::string> walls_fault(const std::vector<WallLine>& lines) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].points.size() < 2) return fmt::format("line {} has fewer than two points", i + 1);
    if (!(lines[i].thickness > 0.0) || !std::isfinite(lines[i].thickness))
      return fmt::format("line {}: thickness {:g} must be positive", i + 1, lines[i].thickness);
    for (const Vector2d& p : lines[i].points)
      if (!p.allFinite()) return fmt::format("line {}: a point is not a finite number", i + 1);
    count += lines[i].points.size() - 1;
  }
  if (count == 0) return "there is no wall";
  if (count > largest_wall_count) return fmt::format("{} walls exceed the limit of {}", count, largest_wall_count);
  Network network = network_of(lines);
  for (const Wall& wall : network.walls)
    if (wall.from == wall.to)
      return fmt::format("a wall at ({:g}, {:g}) has no length", network.nodes[wall.from].x(),
                         network.nodes[wall.from].y());
  if (!connected(network)) return "the walls are not connected; they are joined only where lines share a point";
  Vector2d centroid;
  move_to_centroid(network, centroid);
  const Matrix2d Q = line_moments(network);
  if (!(Q.determinant() > 1e-9 * Q.trace() * Q.trace())) return "all walls lie on one straight line";
  return std::nullopt;
}

Vector2d walls_centroid(const std::vector<WallLine>& lines) {
  Network network = network_of(lines);
  Vector2d centroid;
  move_to_centroid(network, centroid);
  return centroid;
}

Section walls_section(const std::vector<WallLine>& lines) {
  Network network = network_of(lines);
  Vector2d centroid;
  Section section;
  section.area = move_to_centroid(network, centroid);
  const Potentials u = solve(network);
  Matrix2d Q = line_moments(network);
  const Matrix2d Q_inverse = Q.inverse();
  const Vector2d turned = Q_inverse * warping_moments(network, u);
  const Vector2d center(-turned.y(), turned.x());
  const Matrix2d compliance = Q_inverse * shear_energies(network, u) * Q_inverse;
  section.torsion_constant = torsion_constant(network, u);
  section.warping_constant = warping_constant(network, u, center);
  for (const Wall& wall : network.walls) {
    const Vector2d normal(-wall.direction.y(), wall.direction.x());
    Q += wall.length * std::pow(wall.thickness, 3) / 12.0 * normal * normal.transpose();
  }
  section.second_moment_z = Q(0, 0);
  section.second_moment_y = Q(1, 1);
  section.second_moment_yz = Q(0, 1);
  section.polar_moment = Q.trace();
  section.shear_area_y = 1.0 / compliance(0, 0);
  section.shear_area_z = 1.0 / compliance(1, 1);
  section.shear_coupling = compliance(0, 1);
  section.shear_center_y = center.x();
  section.shear_center_z = center.y();
  drop_round_off(section);
  return section;
}

}  // namespace tisserand::formats

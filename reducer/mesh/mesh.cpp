// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the mesh before the solution: its rigid motions, whether it is one piece, whether it is held.
#include "reducer/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "common/text.hpp"
#include "reducer/mesh/coordinates.hpp"

namespace tisserand::reducer {
namespace {

/// Piece number of every node, in the order of first nodes; nodes joined by an element or a tie are in one piece.
std::vector<int> pieces(const Mesh& mesh) {
  std::vector<int> parent(mesh.nodes());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto connect = [&](int m, int n) {
    const int a = root(m), b = root(n);
    parent[std::max(a, b)] = std::min(a, b);
  };
  for (int e = 0; e < mesh.elements(); ++e) {
    const ElementNodes nodes = element_nodes(mesh, e);
    for (int i = 1; i < nodes.count; ++i) connect(nodes.node[0], nodes.node[i]);
  }
  for (const Spider& spider : mesh.spiders)
    for (const int n : spider.nodes) connect(spider.reference, n);
  for (const TieEquation& equation : mesh.equations)
    for (const TieTerm& term : equation.terms) connect(equation.terms[0].node, term.node);
  std::vector<int> result(mesh.nodes());
  for (int i = 0; i < mesh.nodes(); ++i) result[i] = root(i);
  return result;
}

struct NearestPair {
  int inside = 0;
  int outside = 0;
  double distance = 0.0;
};

/// Smallest gap between the piece `chosen` and all others; a sort along x finds near pairs quickly.
NearestPair nearest_pair(const Mesh& mesh, const std::vector<int>& piece, int chosen) {
  std::vector<int> order(mesh.nodes());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return mesh.position(0, a) < mesh.position(0, b); });
  NearestPair best{0, 0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const int a = order[i], b = order[j];
      if (mesh.position(0, b) - mesh.position(0, a) > best.distance) break;
      if ((piece[a] == chosen) == (piece[b] == chosen)) continue;
      const double distance = (mesh.position.col(a) - mesh.position.col(b)).norm();
      if (distance < best.distance)
        best = piece[a] == chosen ? NearestPair{a, b, distance} : NearestPair{b, a, distance};
    }
  return best;
}

std::string vector_text(const Eigen::Vector3d& v) {
  const Eigen::Vector3d w = v.unaryExpr([](double x) { return std::abs(x) < 1e-9 ? 0.0 : x; });
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", w.x(), w.y(), w.z());
}

/// Reduced column echelon form of a basis of motions (6 x k), which gives the simplest description of the space.
Eigen::MatrixXd echelon(Eigen::MatrixXd basis) {
  Eigen::Index column = 0;
  for (Eigen::Index row = basis.rows() - 1; row >= 0 && column < basis.cols(); --row) {
    Eigen::Index pivot = 0;
    const double largest = basis.row(row).tail(basis.cols() - column).cwiseAbs().maxCoeff(&pivot);
    if (largest < 1e-8) continue;
    basis.col(column).swap(basis.col(column + pivot));
    basis.col(column) /= basis(row, column);
    for (Eigen::Index other = 0; other < basis.cols(); ++other)
      if (other != column) basis.col(other) -= basis(row, other) * basis.col(column);
    ++column;
  }
  return basis;
}

/// Description of a rigid motion [velocity of `center`; angular velocity]: "turning about the axis ... through ...".
std::string motion_text(const Eigen::Matrix<double, 6, 1>& motion, const Eigen::Vector3d& center, double length) {
  const Eigen::Vector3d v = motion.head<3>();
  const Eigen::Vector3d w = motion.tail<3>() / length;
  if (w.norm() * length < 1e-8 * v.norm()) return "moving along " + vector_text(v.normalized());
  const Eigen::Vector3d on_axis = center + w.cross(v) / w.squaredNorm();
  return fmt::format("turning about the axis {} through {}", vector_text(w.normalized()), vector_text(on_axis));
}

std::string boundary_text(const Mesh& mesh) {
  std::vector<std::string> words;
  for (const MeshBoundary& b : mesh.boundary)
    words.push_back(b.name + (b.translations && b.rotations ? ""
                              : b.translations              ? " (translations)"
                                                            : " (rotations)"));
  return join(words, ", ");
}

}  // namespace

Eigen::Vector3d normal_of(const Mesh& mesh, const ShellElement& shell) {
  const auto x = [&](int k) { return Eigen::Vector3d(mesh.position.col(shell.nodes[k])); };
  return shell.corners() == 3 ? (x(1) - x(0)).cross(x(2) - x(0)) : (x(2) - x(0)).cross(x(3) - x(1));
}

double characteristic_length(const Mesh& mesh) {
  const Eigen::Vector3d mean = mesh.position.rowwise().mean();
  const double length = (mesh.position.colwise() - mean).colwise().norm().maxCoeff();
  return length > 0.0 ? length : 1.0;
}

void check_connected(const Mesh& mesh, const std::string& where) {
  const std::vector<int> piece = pieces(mesh);
  std::vector<int> first;
  for (int i = 0; i < mesh.nodes(); ++i)
    if (piece[i] == i) first.push_back(i);
  if (first.size() <= 1) return;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min<std::size_t>(first.size(), 10); ++i)
    names.push_back(fmt::format("one with {} ({} nodes)", mesh.node_label[first[i]],
                                std::count(piece.begin(), piece.end(), first[i])));
  const NearestPair gap = nearest_pair(mesh, piece, first[1]);
  throw Error(
      fmt::format("the part is in {} pieces that no element connects: {}", first.size(),
                  listed(names, ", ", first.size())),
      where,
      fmt::format("connect them: the nearest nodes are {} and {}, {:.6g} apart. Elements are connected only where they "
                  "share a node (beams: a point of the same name), or by a spider",
                  mesh.node_label[gap.inside], mesh.node_label[gap.outside], gap.distance));
}

std::vector<std::string> free_motions(const Mesh& mesh, const std::vector<HeldComponents>& held) {
  const double length = characteristic_length(mesh);
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  int translational = 0;
  for (const HeldComponents& h : held)
    if ((h.components & translations_only) != 0) center += mesh.position.col(h.node), ++translational;
  center =
      translational > 0 ? Eigen::Vector3d(center / translational) : Eigen::Vector3d(mesh.position.rowwise().mean());

  Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(6 * std::max<Eigen::Index>(held.size(), 1), 6);
  for (std::size_t h = 0; h < held.size(); ++h) {
    auto rows = seen.middleRows<6>(6 * static_cast<Eigen::Index>(h));
    rows.setIdentity();
    rows.topRightCorner<3, 3>() = -skew<double>((mesh.position.col(held[h].node) - center) / length);
    for (int c = 0; c < 6; ++c)
      if ((held[h].components >> c & 1) == 0) rows.row(c).setZero();
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(seen, Eigen::ComputeFullV);
  const Eigen::Index rank = (svd.singularValues().array() > 1e-9 * svd.singularValues()(0)).count();
  const Eigen::MatrixXd free = echelon(svd.matrixV().rightCols(6 - rank));
  std::vector<std::string> words;
  for (Eigen::Index k = 0; k < free.cols(); ++k) words.push_back(motion_text(free.col(k), center, length));
  return words;
}

void check_boundary_holds(const Mesh& mesh, const std::string& where) {
  std::vector<HeldComponents> held;
  for (const MeshBoundary& b : mesh.boundary)
    held.push_back({b.node, static_cast<Components>((b.translations ? translations_only : 0) |
                                                    (b.rotations ? rotations_only : 0))});
  const std::vector<std::string> words = free_motions(mesh, held);
  if (words.empty()) return;
  throw Error(
      fmt::format("the part can still move when the boundary {} is fixed: {}", boundary_text(mesh), join(words, "; ")),
      where, "retain more coordinates: a boundary node with translations and rotations, or more boundary nodes");
}

}  // namespace tisserand::reducer

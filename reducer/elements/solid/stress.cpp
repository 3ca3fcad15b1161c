// SPDX-License-Identifier: GPL-3.0-or-later
// Stresses of solid elements at their nodes, by a polynomial through the quadrature points of the stiffness.
#include <Eigen/LU>
#include <Eigen/QR>

#include "reducer/elements/element_stress.hpp"
#include "reducer/elements/solid/gradients.hpp"

namespace tisserand::reducer {
namespace {

/// Terms of the polynomial: {1}, {1, r, s, t}, {1, r, s} x {1, t} or {1, r} x {1, s} x {1, t}.
template <SolidShape shape>
Eigen::VectorXd polynomial(const NaturalPoint& p) {
  const double r = p[0], s = p[1], t = p[2];
  if constexpr (shape == SolidShape::tetrahedron4) return Eigen::VectorXd::Ones(1);
  if constexpr (shape == SolidShape::tetrahedron10) return Eigen::Vector4d(1.0, r, s, t);
  if constexpr (shape == SolidShape::prism6 || shape == SolidShape::prism15)
    return Eigen::Vector<double, 6>{1.0, r, s, t, r * t, s * t};
  return Eigen::Vector<double, 8>{1.0, r, s, t, r * s, s * t, t * r, r * s * t};
}

template <SolidShape shape>
Eigen::MatrixXd polynomials(const auto& points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd rows(count, polynomial<shape>(points[0]).size());
  for (Eigen::Index i = 0; i < count; ++i) rows.row(i) = polynomial<shape>(points[i]).transpose();
  return rows;
}

/// Nodes x quadrature points: values at the nodes of the least-squares polynomial through the points.
template <SolidShape shape>
Eigen::MatrixXd extrapolation() {
  static constexpr auto rule = stiffness_rule<shape>();
  const Eigen::MatrixXd at_points = polynomials<shape>(rule.point);
  const Eigen::MatrixXd inverse = at_points.completeOrthogonalDecomposition().pseudoInverse();
  return polynomials<shape>(SolidBasis<shape>::nodes) * inverse;
}

/// Strain [xx yy zz xy yz zx] of the displacements along axis i of a function with gradient g.
void add_strain(const Eigen::Vector3d& g, Eigen::Index column, Eigen::MatrixXd& B) {
  B.col(column) << g.x(), 0.0, 0.0, g.y(), 0.0, g.z();
  B.col(column + 1) << 0.0, g.y(), 0.0, g.x(), g.z(), 0.0;
  B.col(column + 2) << 0.0, 0.0, g.z(), 0.0, g.y(), g.x();
}

/// Amplitudes of the incompatible displacements for motions of the nodes: −S_aa⁻¹ S_au.
template <int Functions>
Eigen::MatrixXd followers(const Eigen::Matrix<double, 6, 6>& C, const Eigen::MatrixXd& G, Eigen::Index kept) {
  const Eigen::Matrix<double, 3 * Functions, 3 * Functions> H = G * G.transpose();
  const Eigen::MatrixXd S = contract<Functions>(C, H);
  const Eigen::Index rest = S.rows() - kept;
  const Eigen::MatrixXd S_aa = S.bottomRightCorner(rest, rest), S_au = S.bottomLeftCorner(rest, kept);
  return -S_aa.partialPivLu().solve(S_au);
}

template <SolidShape shape>
Eigen::MatrixXd stress_at_nodes(const Mesh& mesh, const SolidElement& solid) {
  static constexpr auto rule = stiffness_rule<shape>();
  static const Eigen::MatrixXd to_nodes = extrapolation<shape>();
  constexpr int nodes = count_of(SolidBasis<shape>::nodes);
  constexpr int modes = static_cast<int>(IncompatibleModes<shape>::size), functions = nodes + modes;
  constexpr int points = count_of(rule.point);
  const Eigen::Matrix<double, 6, 6>& C = mesh.solid_properties[solid.property].material.C;
  const auto x = node_positions<shape>(mesh, solid);
  const auto G = weighted_gradients<shape>(x, solid.id);
  Eigen::MatrixXd follow;
  if constexpr (modes > 0) follow = followers<functions>(C, G.slope, 3 * nodes);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6 * nodes, 3 * nodes);
  for (int q = 0; q < points; ++q) {
    const Eigen::Map<const Eigen::Matrix<double, functions, 3>> gradient(G.slope.col(q).data());
    Eigen::MatrixXd B(6, 3 * functions);
    for (int a = 0; a < functions; ++a) add_strain(gradient.row(a).transpose() / G.root[q], 3 * a, B);
    Eigen::MatrixXd strain = B.leftCols(3 * nodes);
    if constexpr (modes > 0) strain += B.rightCols(3 * modes) * follow;
    const Eigen::MatrixXd stress = C * strain;
    for (int a = 0; a < nodes; ++a) out.middleRows<6>(6 * a) += to_nodes(a, q) * stress;
  }
  return out;
}

}  // namespace

Eigen::MatrixXd solid_stress(const Mesh& mesh, const SolidElement& solid) {
  return with_shape(solid.shape, [&]<SolidShape shape>() { return stress_at_nodes<shape>(mesh, solid); });
}

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Gradients of solid elements' shape functions at quadrature points: for stiffness, mass, stress, second order.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>
#include <Eigen/LU>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "reducer/elements/solid/quadrature.hpp"
#include "reducer/elements/solid/shapes.hpp"

namespace tisserand::reducer {

/// Incompatible displacements of a solid: their number, their gradients by the natural coordinates, and the centre
/// where their Jacobian J0 is evaluated. Most shapes have none.
template <SolidShape shape>
struct IncompatibleModes {
  static constexpr std::size_t size = 0;
  static constexpr NaturalPoint centre{0.0, 0.0, 0.0};
  static constexpr std::array<NaturalPoint, 0> gradients(const NaturalPoint&) { return {}; }
};

/// Incompatible displacements 1 − r², 1 − s², 1 − t² of the eight-node hexahedron, times −½.
template <>
struct IncompatibleModes<SolidShape::hexahedron8> {
  static constexpr std::size_t size = 3;
  static constexpr NaturalPoint centre{0.0, 0.0, 0.0};
  static constexpr std::array<NaturalPoint, 3> gradients(const NaturalPoint& p) {
    return {{{p[0], 0.0, 0.0}, {0.0, p[1], 0.0}, {0.0, 0.0, p[2]}}};
  }
};

/// Incompatible displacements of the six-node prism, up to constant factors: 1 − t² for bending along t, and r², rs,
/// s² minus their mean gradients for the linear strains across t.
template <>
struct IncompatibleModes<SolidShape::prism6> {
  static constexpr std::size_t size = 4;
  static constexpr NaturalPoint centre{1.0 / 3.0, 1.0 / 3.0, 0.0};
  static constexpr std::array<NaturalPoint, 4> gradients(const NaturalPoint& p) {
    const double r = p[0] - centre[0], s = p[1] - centre[1];
    return {{{0.0, 0.0, p[2]}, {r, 0.0, 0.0}, {s, r, 0.0}, {0.0, s, 0.0}}};
  }
};

/// Derivatives of all functions of a shape by r, s, t at one point: [natural coordinate][function].
template <std::size_t Functions>
using NaturalGradients = std::array<std::array<double, Functions>, 3>;

/// Shape functions of a solid and their natural gradients at the quadrature points, with the weights.
template <SolidShape shape, std::size_t Points>
struct ShapeTable {
  static constexpr std::size_t nodes = SolidBasis<shape>::nodes.size();
  std::array<double, Points> weight{};
  std::array<std::array<double, nodes>, Points> value{};
  std::array<NaturalGradients<nodes>, Points> gradient{};
};

template <SolidShape shape>
constexpr auto nodal_gradients(const NaturalPoint& point) {
  NaturalGradients<SolidBasis<shape>::nodes.size()> gradients{};
  const auto x = natural_jets(point);
  const auto N = SolidBasis<shape>::functions(x[0], x[1], x[2]);
  for (std::size_t a = 0; a < N.size(); ++a)
    for (std::size_t k = 0; k < 3; ++k) gradients[k][a] = N[a].slope[k];
  return gradients;
}

template <SolidShape shape, std::size_t Points>
constexpr ShapeTable<shape, Points> tabulate(const QuadratureRule<Points>& rule) {
  ShapeTable<shape, Points> table;
  table.weight = rule.weight;
  for (std::size_t q = 0; q < Points; ++q) {
    const auto x = natural_jets(rule.point[q]);
    const auto N = SolidBasis<shape>::functions(x[0], x[1], x[2]);
    for (std::size_t a = 0; a < N.size(); ++a) table.value[q][a] = N[a].value;
    table.gradient[q] = nodal_gradients<shape>(rule.point[q]);
  }
  return table;
}

template <int Functions>
using GradientMap = Eigen::Map<const Eigen::Matrix<double, Functions, 3>>;
template <int Nodes>
using NodePositions = Eigen::Matrix<double, 3, Nodes>;

/// Jacobian matrix J(i, k) = ∂x_i/∂ξ_k at a point, from the positions of the nodes and the natural gradients there.
template <int Nodes>
Eigen::Matrix3d jacobian(const NodePositions<Nodes>& x, const NaturalGradients<Nodes>& gradient) {
  return x.lazyProduct(GradientMap<Nodes>(gradient[0].data()));
}

/// Gradients ∂N/∂x of all functions at all integration points, times `root` = √(weight det J) of the point. Each point
/// has one column; the derivative of function a by x_k is in row k · functions + a.
template <int Functions, int Points>
struct WeightedGradients {
  Eigen::Matrix<double, 3 * Functions, Points> slope;
  Eigen::Matrix<double, Points, 1> root;
};

template <SolidShape shape>
auto weighted_gradients(const NodePositions<count_of(SolidBasis<shape>::nodes)>& x, int id) {
  using Modes = IncompatibleModes<shape>;
  static constexpr auto rule = stiffness_rule<shape>();
  static constexpr auto table = tabulate<shape>(rule);
  static constexpr auto centre = nodal_gradients<shape>(Modes::centre);
  constexpr int points = count_of(rule.point);
  constexpr int nodes = count_of(SolidBasis<shape>::nodes);
  constexpr int modes = static_cast<int>(Modes::size), functions = nodes + modes;

  WeightedGradients<functions, points> G;
  const Eigen::Matrix3d J0 = jacobian<nodes>(x, centre);
  const Eigen::Matrix3d inverse0 = J0.inverse();
  for (int q = 0; q < points; ++q) {
    const std::size_t point = static_cast<std::size_t>(q);
    const Eigen::Matrix3d J = jacobian<nodes>(x, table.gradient[point]);
    const double det = J.determinant();
    TISSERAND_ENSURE(det > 0.0, "solid element {}: Jacobian {} at quadrature point {}", id, det, q);
    const double root = std::sqrt(table.weight[point] * det);
    G.root[q] = root;
    Eigen::Map<Eigen::Matrix<double, functions, 3>> column(G.slope.col(q).data());
    column.template topRows<nodes>() =
        GradientMap<nodes>(table.gradient[point][0].data()).lazyProduct(root * J.inverse());
    if constexpr (modes > 0) {
      const auto g = Modes::gradients(rule.point[point]);
      const Eigen::Map<const Eigen::Matrix<double, 3, modes>> natural(g[0].data());
      column.template bottomRows<modes>() = natural.transpose().lazyProduct(root * J0.determinant() / det * inverse0);
    }
  }
  return G;
}

/// Stiffness S(3a + i, 3b + j) = Σ_kl c_ikjl H_kl(a, b) for every pair a, b of functions. `C`: elasticity (6 x 6) in
/// the order xx yy zz xy yz zx. `H`: products of gradients, gram() of the weighted gradients.
template <int Functions>
Eigen::Matrix<double, 3 * Functions, 3 * Functions> contract(
    const Eigen::Matrix<double, 6, 6>& C, const Eigen::Matrix<double, 3 * Functions, 3 * Functions>& H) {
  constexpr int strain[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};  // row of C of the tensor indices
  Eigen::Matrix<double, 3 * Functions, 3 * Functions> S;
  Eigen::Matrix<double, Functions, Functions> block;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      block.setZero();
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) {
          const double c = C(strain[i][k], strain[j][l]);
          if (c != 0.0) block += c * H.template block<Functions, Functions>(k * Functions, l * Functions);
        }
      for (int b = 0; b < Functions; ++b)
        for (int a = 0; a < Functions; ++a) {
          S(3 * a + i, 3 * b + j) = block(a, b);
          S(3 * b + j, 3 * a + i) = block(a, b);
        }
    }
  return S;
}

/// Rows that give the strain [xx yy zz xy yz zx] for displacements of functions with the gradients `slope` (6 x (3
/// functions)). `slope` has one row per function.
template <int Functions>
Eigen::Matrix<double, 6, 3 * Functions> strain_rows(const Eigen::Matrix<double, Functions, 3>& slope) {
  constexpr int pair[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  Eigen::Matrix<double, 6, 3 * Functions> rows = Eigen::Matrix<double, 6, 3 * Functions>::Zero();
  for (int a = 0; a < Functions; ++a)
    for (int k = 0; k < 3; ++k) {
      rows(k, 3 * a + k) = slope(a, k);
      rows(3 + k, 3 * a + pair[k][0]) = slope(a, pair[k][1]);
      rows(3 + k, 3 * a + pair[k][1]) = slope(a, pair[k][0]);
    }
  return rows;
}

/// Computes H = G Gᵀ. It is no template, so that the compiler sees one matrix product instead of six.
inline void gram(const Eigen::Ref<const Eigen::MatrixXd>& G, Eigen::Ref<Eigen::MatrixXd> H) {
  H.noalias() = G * G.transpose();
}

/// Positions of the nodes of a solid relative to its first node (3 x nodes). So no digits cancel far from the origin.
template <SolidShape shape>
auto node_positions(const Mesh& mesh, const SolidElement& solid) {
  constexpr int nodes = count_of(SolidBasis<shape>::nodes);
  NodePositions<nodes> x;
  for (int a = 0; a < nodes; ++a) x.col(a) = mesh.position.col(solid.nodes[a]) - mesh.position.col(solid.nodes[0]);
  return x;
}

}  // namespace tisserand::reducer

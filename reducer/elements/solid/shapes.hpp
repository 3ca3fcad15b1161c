// SPDX-License-Identifier: GPL-3.0-or-later
// Shape functions of the solid elements and their natural gradients at a point of the reference element.
//
// Reference elements as in gmsh: tetrahedra r, s, t ≥ 0, r + s + t ≤ 1; hexahedra −1 ≤ r, s, t ≤ 1; prisms r, s ≥ 0, r
// + s ≤ 1, −1 ≤ t ≤ 1. All functions are polynomials, which the compiler can evaluate.
#pragma once

#include <array>
#include <cstddef>

#include "common/error.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

using NaturalPoint = std::array<double, 3>;

/// Value of a function at a point, and its derivatives by r, s, t.
struct Jet {
  double value = 0.0;
  std::array<double, 3> slope{};
};
constexpr Jet operator+(const Jet& a, const Jet& b) {
  return {a.value + b.value, {a.slope[0] + b.slope[0], a.slope[1] + b.slope[1], a.slope[2] + b.slope[2]}};
}
constexpr Jet operator*(double f, const Jet& a) {
  return {f * a.value, {f * a.slope[0], f * a.slope[1], f * a.slope[2]}};
}
constexpr Jet operator+(double f, const Jet& a) { return {f + a.value, a.slope}; }
constexpr Jet operator-(const Jet& a, const Jet& b) { return a + -1.0 * b; }
constexpr Jet operator-(double f, const Jet& a) { return f + -1.0 * a; }
constexpr Jet operator*(const Jet& a, const Jet& b) {
  Jet product{a.value * b.value, {}};
  for (std::size_t k = 0; k < 3; ++k) product.slope[k] = a.slope[k] * b.value + a.value * b.slope[k];
  return product;
}

/// Natural coordinates r, s, t of the point `p` as jets, each with its unit derivative.
constexpr std::array<Jet, 3> natural_jets(const NaturalPoint& p) {
  return {Jet{p[0], {1.0, 0.0, 0.0}}, Jet{p[1], {0.0, 1.0, 0.0}}, Jet{p[2], {0.0, 0.0, 1.0}}};
}

using Edge = std::array<std::size_t, 2>;

/// Edges of the tetrahedron as pairs of corners, in the order in which gmsh numbers the nodes in the middles of the
/// edges.
inline constexpr std::array<Edge, 6> tetrahedron_edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}};
inline constexpr std::array<Edge, 12> hexahedron_edges{
    {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}}};
inline constexpr std::array<Edge, 9> prism_edges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}};

inline constexpr std::array<NaturalPoint, 4> tetrahedron_corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
inline constexpr std::array<NaturalPoint, 8> hexahedron_corners{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
inline constexpr std::array<NaturalPoint, 6> prism_corners{
    {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};

/// Natural coordinates of the nodes of a second-order shape: the corners, then the middles of the edges.
template <std::size_t Corners, std::size_t Edges>
constexpr std::array<NaturalPoint, Corners + Edges> with_middles(const std::array<NaturalPoint, Corners>& corners,
                                                                 const std::array<Edge, Edges>& edges) {
  std::array<NaturalPoint, Corners + Edges> points{};
  for (std::size_t i = 0; i < Corners; ++i) points[i] = corners[i];
  for (std::size_t e = 0; e < Edges; ++e)
    for (std::size_t k = 0; k < 3; ++k)
      points[Corners + e][k] = 0.5 * (corners[edges[e][0]][k] + corners[edges[e][1]][k]);
  return points;
}

/// Data of a solid shape: number of its `corners`, its `edges`, natural coordinates of its `nodes`, and functions(r,
/// s, t). functions() gives one shape function per node, with functions_i(nodes_j) = δ_ij and Σ functions = 1.
template <SolidShape shape>
struct SolidBasis;

template <>
struct SolidBasis<SolidShape::tetrahedron4> {
  static constexpr std::size_t corners = 4;
  static constexpr auto edges = tetrahedron_edges;
  static constexpr auto nodes = tetrahedron_corners;
  static constexpr std::array<Jet, 4> functions(const Jet& r, const Jet& s, const Jet& t) {
    return {1.0 - (r + s + t), r, s, t};
  }
};

template <>
struct SolidBasis<SolidShape::tetrahedron10> {
  static constexpr std::size_t corners = 4;
  static constexpr auto edges = tetrahedron_edges;
  static constexpr auto nodes = with_middles(tetrahedron_corners, tetrahedron_edges);
  static constexpr std::array<Jet, 10> functions(const Jet& r, const Jet& s, const Jet& t) {
    const std::array<Jet, 4> L{1.0 - (r + s + t), r, s, t};
    std::array<Jet, 10> N{};
    for (std::size_t i = 0; i < 4; ++i) N[i] = L[i] * (2.0 * L[i] - Jet{1.0, {}});
    for (std::size_t e = 0; e < edges.size(); ++e) N[4 + e] = 4.0 * (L[edges[e][0]] * L[edges[e][1]]);
    return N;
  }
};

template <>
struct SolidBasis<SolidShape::hexahedron8> {
  static constexpr std::size_t corners = 8;
  static constexpr auto edges = hexahedron_edges;
  static constexpr auto nodes = hexahedron_corners;
  static constexpr std::array<Jet, 8> functions(const Jet& r, const Jet& s, const Jet& t) {
    std::array<Jet, 8> N{};
    for (std::size_t i = 0; i < 8; ++i)
      N[i] = 0.125 * ((1.0 + nodes[i][0] * r) * (1.0 + nodes[i][1] * s) * (1.0 + nodes[i][2] * t));
    return N;
  }
};

template <>
struct SolidBasis<SolidShape::hexahedron20> {
  static constexpr std::size_t corners = 8;
  static constexpr auto edges = hexahedron_edges;
  static constexpr auto nodes = with_middles(hexahedron_corners, hexahedron_edges);
  /// Shape functions of the 20-node hexahedron. Along the coordinate x of an edge, the factor of its middle node is 1
  /// − x². Every other factor of node i is 1 + x x_i.
  static constexpr std::array<Jet, 20> functions(const Jet& r, const Jet& s, const Jet& t) {
    const std::array<Jet, 3> x{r, s, t};
    std::array<Jet, 20> N{};
    for (std::size_t i = 0; i < 20; ++i) {
      Jet product{i < 8 ? 0.125 : 0.25, {}};
      Jet sum{-2.0, {}};
      for (std::size_t k = 0; k < 3; ++k) {
        product = product * (nodes[i][k] == 0.0 ? 1.0 - x[k] * x[k] : 1.0 + nodes[i][k] * x[k]);
        sum = sum + nodes[i][k] * x[k];
      }
      N[i] = i < 8 ? product * sum : product;
    }
    return N;
  }
};

template <>
struct SolidBasis<SolidShape::prism6> {
  static constexpr std::size_t corners = 6;
  static constexpr auto edges = prism_edges;
  static constexpr auto nodes = prism_corners;
  static constexpr std::array<Jet, 6> functions(const Jet& r, const Jet& s, const Jet& t) {
    const std::array<Jet, 3> L{1.0 - (r + s), r, s};
    std::array<Jet, 6> N{};
    for (std::size_t i = 0; i < 6; ++i) N[i] = 0.5 * (L[i % 3] * (1.0 + nodes[i][2] * t));
    return N;
  }
};

template <>
struct SolidBasis<SolidShape::prism15> {
  static constexpr std::size_t corners = 6;
  static constexpr auto edges = prism_edges;
  static constexpr auto nodes = with_middles(prism_corners, prism_edges);
  static constexpr std::array<Jet, 15> functions(const Jet& r, const Jet& s, const Jet& t) {
    const std::array<Jet, 3> L{1.0 - (r + s), r, s};
    const Jet bubble = 1.0 - t * t;
    std::array<Jet, 15> N{};
    for (std::size_t i = 0; i < 6; ++i) {
      const Jet& l = L[i % 3];
      N[i] = 0.5 * (l * ((2.0 * l - Jet{1.0, {}}) * (1.0 + nodes[i][2] * t) - bubble));
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::size_t i = edges[e][0], j = edges[e][1];
      N[6 + e] = j == i + 3 ? L[i] * bubble : 2.0 * (L[i % 3] * L[j % 3] * (1.0 + nodes[i][2] * t));
    }
    return N;
  }
};

/// Calls `work` with the shape as a template argument, and returns its result.
auto with_shape(SolidShape shape, const auto& work) {
  switch (shape) {
    case SolidShape::tetrahedron4:
      return work.template operator()<SolidShape::tetrahedron4>();
    case SolidShape::tetrahedron10:
      return work.template operator()<SolidShape::tetrahedron10>();
    case SolidShape::hexahedron8:
      return work.template operator()<SolidShape::hexahedron8>();
    case SolidShape::hexahedron20:
      return work.template operator()<SolidShape::hexahedron20>();
    case SolidShape::prism6:
      return work.template operator()<SolidShape::prism6>();
    case SolidShape::prism15:
      return work.template operator()<SolidShape::prism15>();
  }
  TISSERAND_ENSURE(false, "solid shape {}", static_cast<int>(shape));
}

}  // namespace tisserand::reducer

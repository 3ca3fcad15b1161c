// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature rules of the reference elements of solids: points and weights as data, and products made from them.
#pragma once

#include <array>
#include <cstddef>

#include "reducer/elements/gauss.hpp"
#include "reducer/elements/solid/shapes.hpp"

namespace tisserand::reducer {

/// Quadrature rule ∫ f ≈ Σ weight f(point) over the reference element.
template <std::size_t Size>
struct QuadratureRule {
  std::array<NaturalPoint, Size> point{};
  std::array<double, Size> weight{};
};

/// Point of a quadrature rule on the unit triangle, with its weight.
struct TrianglePoint {
  double r;
  double s;
  double weight;
};
/// Quadrature rule of degree 2 with three inner points on the triangle of area 1/2. `triangle7` is the rule of degree
/// 5 with seven points ([Cow73]).
inline constexpr std::array<TrianglePoint, 3> triangle3{
    {{1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0}, {2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0}, {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0}}};
inline constexpr double triangle7_a = 0.10128650732345633880, triangle7_b = 0.47014206410511508977;
inline constexpr double triangle7_wa = 0.5 * 0.12593918054482715260, triangle7_wb = 0.5 * 0.13239415278850618074;
inline constexpr std::array<TrianglePoint, 7> triangle7{{{1.0 / 3.0, 1.0 / 3.0, 0.1125},
                                                         {triangle7_a, triangle7_a, triangle7_wa},
                                                         {1.0 - 2.0 * triangle7_a, triangle7_a, triangle7_wa},
                                                         {triangle7_a, 1.0 - 2.0 * triangle7_a, triangle7_wa},
                                                         {triangle7_b, triangle7_b, triangle7_wb},
                                                         {1.0 - 2.0 * triangle7_b, triangle7_b, triangle7_wb},
                                                         {triangle7_b, 1.0 - 2.0 * triangle7_b, triangle7_wb}}};

template <std::size_t Line>
constexpr QuadratureRule<Line * Line * Line> hexahedron_rule(const std::array<GaussPoint, Line>& line) {
  QuadratureRule<Line * Line * Line> rule;
  std::size_t q = 0;
  for (const GaussPoint& a : line)
    for (const GaussPoint& b : line)
      for (const GaussPoint& c : line) {
        rule.point[q] = {a.at, b.at, c.at};
        rule.weight[q++] = a.weight * b.weight * c.weight;
      }
  return rule;
}

template <std::size_t Triangle, std::size_t Line>
constexpr QuadratureRule<Triangle * Line> prism_rule(const std::array<TrianglePoint, Triangle>& triangle,
                                                     const std::array<GaussPoint, Line>& line) {
  QuadratureRule<Triangle * Line> rule;
  std::size_t q = 0;
  for (const GaussPoint& a : line)
    for (const TrianglePoint& b : triangle) {
      rule.point[q] = {b.r, b.s, a.at};
      rule.weight[q++] = a.weight * b.weight;
    }
  return rule;
}

/// Sets the four points with barycentric coordinates (1 − 3a, a, a, a) and permutations in `rule`, from index `first`
/// on, each with this weight.
constexpr void add_corner_orbit(double a, double weight, std::size_t first, auto& rule) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) rule.point[first + i][k] = k + 1 == i ? 1.0 - 3.0 * a : a;
    rule.weight[first + i] = weight;
  }
}

constexpr QuadratureRule<1> tetrahedron1() { return {{{{0.25, 0.25, 0.25}}}, {1.0 / 6.0}}; }

/// Quadrature rule of degree 2 on the tetrahedron, with four points at a = (5 − √5)/20 ([HS56]).
constexpr QuadratureRule<4> tetrahedron4_rule() {
  QuadratureRule<4> rule;
  add_corner_orbit(0.13819660112501051518, 1.0 / 24.0, 0, rule);
  return rule;
}

/// Quadrature rule of degree 5 on the tetrahedron, with 14 inner points and positive weights ([Wal00]).
constexpr QuadratureRule<14> tetrahedron14() {
  QuadratureRule<14> rule;
  add_corner_orbit(0.31088591926330060980, 0.11268792571801585080 / 6.0, 0, rule);
  add_corner_orbit(0.092735250310891226402, 0.073493043116361949544 / 6.0, 4, rule);
  constexpr double a = 0.045503704125649649492, b = 0.5 - a;
  for (std::size_t e = 0; e < tetrahedron_edges.size(); ++e) {
    for (std::size_t k = 0; k < 3; ++k)
      rule.point[8 + e][k] = tetrahedron_edges[e][0] == k + 1 || tetrahedron_edges[e][1] == k + 1 ? b : a;
    rule.weight[8 + e] = 0.042546020777081466438 / 6.0;
  }
  return rule;
}

/// Quadrature rule of the stiffness of a shape. It has as few points as keep the rank (6 points ≥ 3 nodes − 6) and the
/// patch test on distorted meshes with straight edges. The ten-node tetrahedron needs four, since 24 = 30 − 6. The
/// 20-node hexahedron gets 27: eight (48 < 54) leave six spurious modes. The 14 of [Iro71] (degree 5) keep the rank.
/// But they lack degree 3 in each direction, which the forces of a constant stress in a distorted element need.
template <SolidShape shape>
constexpr auto stiffness_rule() {
  if constexpr (shape == SolidShape::tetrahedron4) return tetrahedron1();
  if constexpr (shape == SolidShape::tetrahedron10) return tetrahedron4_rule();
  if constexpr (shape == SolidShape::hexahedron8) return hexahedron_rule(gauss2);
  if constexpr (shape == SolidShape::hexahedron20) return hexahedron_rule(gauss3);
  if constexpr (shape == SolidShape::prism6) return prism_rule(triangle3, gauss2);
  if constexpr (shape == SolidShape::prism15) return prism_rule(triangle3, gauss3);
}

/// Quadrature rule of the mass of a shape. It is exact for elements with straight edges. For shapes that are not
/// quadratic it is exact with any edges.
template <SolidShape shape>
constexpr auto mass_rule() {
  if constexpr (shape == SolidShape::tetrahedron4) return tetrahedron4_rule();
  if constexpr (shape == SolidShape::tetrahedron10) return tetrahedron14();
  if constexpr (shape == SolidShape::hexahedron8) return hexahedron_rule(gauss3);
  if constexpr (shape == SolidShape::hexahedron20) return hexahedron_rule(gauss3);
  if constexpr (shape == SolidShape::prism6) return prism_rule(triangle7, gauss3);
  if constexpr (shape == SolidShape::prism15) return prism_rule(triangle7, gauss3);
}

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Gauss-Legendre rules on [-1, 1], the factors of the rules of quadrilaterals, bricks and prisms.
#pragma once

#include <array>

namespace tisserand::reducer {

/// Point of a Gauss quadrature rule on the interval from -1 to 1, with its weight.
struct GaussPoint {
  double at;
  double weight;
};
/// Gauss-Legendre rule of two points, exact up to degree 3. `gauss3` with three points is exact up to degree 5.
inline constexpr std::array<GaussPoint, 2> gauss2{{{-0.57735026918962576451, 1.0}, {0.57735026918962576451, 1.0}}};
inline constexpr std::array<GaussPoint, 3> gauss3{
    {{-0.77459666924148337704, 5.0 / 9.0}, {0.0, 8.0 / 9.0}, {0.77459666924148337704, 5.0 / 9.0}}};

}  // namespace tisserand::reducer

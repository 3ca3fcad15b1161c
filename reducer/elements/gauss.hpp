// Gauss-Legendre rules on [-1, 1], from which those of quadrilaterals, bricks and prisms are made.
#pragma once

#include <array>

namespace tisserand::reducer {

struct GaussPoint {
  double at;
  double weight;
};
/// Exact up to degree 3 and 5.
inline constexpr std::array<GaussPoint, 2> gauss2{{{-0.57735026918962576451, 1.0}, {0.57735026918962576451, 1.0}}};
inline constexpr std::array<GaussPoint, 3> gauss3{
    {{-0.77459666924148337704, 5.0 / 9.0}, {0.0, 8.0 / 9.0}, {0.77459666924148337704, 5.0 / 9.0}}};

}  // namespace tisserand::reducer

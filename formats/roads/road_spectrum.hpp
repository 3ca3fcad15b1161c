// Stochastic roads by class and seed, as tables of heights.
#pragma once

#include "formats/tables/function_spec.hpp"

namespace tisserand::formats {

enum class RoadClass { A, B, C, D, E, F, G, H };

/// A piece of a road of ISO 8608: displacement spectrum G_d(n) = G₀ (n/n₀)⁻² per side, n₀ = 0.1/m, between 0.011
/// and 2.83 waves per metre, G₀ = 16 · 4ᵏ mm² m, the geometric mean of class k = 0 (A) to 7 (H).
struct IsoRoadSpec {
  RoadClass road_class = RoadClass::A;
  int seed = 0;
  double start = 0.0;   ///< x at which it begins
  double length = 0.0;  ///< on which it fades in and out over the first and last quarter, at most 5 m
};
inline constexpr double longest_iso_road = 20e3;  ///< m

/// Points 2 cm apart of a sum of 300 waves, one in each of as many bands of equal logarithmic width, with the exact
/// power of its band and a phase and frequency that the seed gives, on every machine the same. `metre`: one unit of
/// length in m.
CurveSpec iso_road(const IsoRoadSpec& spec, double metre);

}  // namespace tisserand::formats

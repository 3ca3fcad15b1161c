// SPDX-License-Identifier: GPL-3.0-or-later
// Stochastic roads by class and seed, as height tables.
#pragma once

#include "formats/tables/function_spec.hpp"

namespace tisserand::formats {

enum class RoadClass { A, B, C, D, E, F, G, H };

/// Piece of a random road of ISO 8608. The displacement spectrum of each side is G_d(n) = G₀ (n/n₀)⁻² for n from 0.011
/// to 2.83 waves per metre, n₀ = 0.1/m. G₀ = 16 · 4ᵏ mm² m is the geometric mean of class k = 0 (A) to 7 (H).
struct IsoRoadSpec {
  RoadClass road_class = RoadClass::A;
  int seed = 0;
  double start = 0.0;   ///< x of the beginning
  double length = 0.0;  ///< length, with fades over the first and last quarter, at most 5 m each
};
inline constexpr double longest_iso_road = 20e3;  ///< [m]

/// Heights of a random road at points about 2 cm apart, as a sum of 300 waves in bands of equal logarithmic width. Each
/// wave has the exact power of its band. The seed gives its phase and frequency, equal on every machine. `metre`: unit
/// of length of the result in m.
CurveSpec iso_road(const IsoRoadSpec& spec, double metre);

}  // namespace tisserand::formats

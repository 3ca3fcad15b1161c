// SPDX-License-Identifier: GPL-3.0-or-later
// Sums the waves of stochastic roads by the recurrence of cosines.
#include "formats/roads/road_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <Eigen/Core>

namespace tisserand::formats {
namespace {

constexpr double first_wave = 0.011, last_wave = 2.83, reference_wave = 0.1;  // per metre
constexpr double class_a = 16e-6;                                             // m³ at the reference
constexpr int waves = 300;
constexpr double spacing = 0.02, longest_fade = 5.0;  // m

/// Adds a cos(2π n x + phase) at x = k h.
void add_wave(double amplitude, double n, double phase, double h, std::vector<double>& z) {
  constexpr std::size_t exact = 256;  // points between exact evaluations; round-off stays at 1e-14
  const double turn = 2.0 * std::numbers::pi * n * h, c = std::cos(turn), s = std::sin(turn);
  double x = 0.0, y = 0.0;
  for (std::size_t k = 0; k < z.size(); ++k) {
    if (k % exact == 0) {
      const double angle = turn * static_cast<double>(k) + phase;
      x = std::cos(angle);
      y = std::sin(angle);
    }
    z[k] += amplitude * x;
    const double next = c * x - s * y;
    y = s * x + c * y;
    x = next;
  }
}

}  // namespace

CurveSpec iso_road(const IsoRoadSpec& spec, double metre) {
  const double length = spec.length * metre, G_0 = class_a * std::pow(4.0, static_cast<int>(spec.road_class));
  const auto points = static_cast<std::size_t>(std::max(4.0, std::ceil(length / spacing))) + 1;
  const double h = length / static_cast<double>(points - 1);
  CurveSpec curve{Interpolation::cubic, std::vector<double>(points), std::vector<double>(points, 0.0)};
  std::mt19937_64 random(static_cast<std::uint64_t>(spec.seed));
  const auto share = [&random] {
    return static_cast<double>(random() >> 11) * 0x1p-53;
  };  // std distributions differ between libraries
  const double ratio = std::pow(last_wave / first_wave, 1.0 / waves);
  for (int i = 0; i < waves; ++i) {
    const double from = first_wave * std::pow(ratio, i), n = from * std::pow(ratio, share());
    const double power = G_0 * reference_wave * reference_wave * (1.0 / from - 1.0 / (from * ratio));  // ∫ G_d dn
    add_wave(std::sqrt(2.0 * power), n, 2.0 * std::numbers::pi * share(), h, curve.y);
  }
  const double fade = std::min(longest_fade, 0.25 * length);
  for (std::size_t k = 0; k < points; ++k) {
    const double x = h * static_cast<double>(k), t = std::min({1.0, x / fade, (length - x) / fade});
    curve.x[k] = spec.start + x / metre;
    curve.y[k] *= t * t * (3.0 - 2.0 * t) / metre;
  }
  return curve;
}

}  // namespace tisserand::formats

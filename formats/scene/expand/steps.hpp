// SPDX-License-Identifier: GPL-3.0-or-later
// Smooth steps for formulas: from y0 before t0 to y1 after t1.
#pragma once

#include <cmath>
#include <limits>

namespace tisserand::formats::steps {

inline constexpr double pi = 3.14159265358979323846;

/// Fraction s of the time from t0 to t1, limited to 0 ≤ s ≤ 1. It is NaN if t1 is not later than t0.
inline double fraction(double t, double t0, double t1) {
  if (!(t1 > t0)) return std::numeric_limits<double>::quiet_NaN();
  return t <= t0 ? 0.0 : t >= t1 ? 1.0 : (t - t0) / (t1 - t0);
}

/// Step y0 + (y1 − y0)(10 s³ − 15 s⁴ + 6 s⁵) with s = fraction(t, t0, t1). Rate and acceleration are 0 at both ends.
/// The peak rate is 15/8 of the mean.
inline double step5(double t, double t0, double y0, double t1, double y1) {
  const double s = fraction(t, t0, t1);
  return s < 0.5 ? y0 + (y1 - y0) * s * s * s * (10.0 + s * (6.0 * s - 15.0))
                 : y1 - (y1 - y0) * (1.0 - s) * (1.0 - s) * (1.0 - s) * (1.0 + s * (3.0 + 6.0 * s));
}

/// Step y0 + (y1 − y0)(s − sin(2πs)/2π) with s = fraction(t, t0, t1). Rate and acceleration are 0 at both ends. The
/// peak rate is twice the mean.
inline double step_cycloid(double t, double t0, double y0, double t1, double y1) {
  const double s = fraction(t, t0, t1);
  return s >= 1.0 ? y1 : y0 + (y1 - y0) * (s - std::sin(2.0 * pi * s) / (2.0 * pi));
}

/// Step y0 + (y1 − y0)(1 − cos(πs))/2 with s = fraction(t, t0, t1). The rate is 0 at both ends, where the acceleration
/// jumps.
inline double step_harmonic(double t, double t0, double y0, double t1, double y1) {
  const double s = fraction(t, t0, t1);
  return s >= 1.0 ? y1 : y0 + (y1 - y0) * 0.5 * (1.0 - std::cos(pi * s));
}

/// Step from y0 to y1 with constant acceleration during the share f of the time t0 to t1, then constant rate, then
/// equal deceleration during the share f. The acceleration is a = ±(y1 − y0)/(f (1 − f) (t1 − t0)²) and jumps. The
/// result is NaN if f is not within (0, 0.5].
inline double step_trapezoid(double t, double t0, double y0, double t1, double y1, double f) {
  if (!(f > 0.0 && f <= 0.5)) return std::numeric_limits<double>::quiet_NaN();
  const double s = fraction(t, t0, t1), rate = 1.0 / (1.0 - f);
  if (s < f) return y0 + (y1 - y0) * 0.5 * rate / f * s * s;
  if (s > 1.0 - f) return y1 - (y1 - y0) * 0.5 * rate / f * (1.0 - s) * (1.0 - s);
  return y0 + (y1 - y0) * rate * (s - 0.5 * f);
}

/// Defines step5, step_cycloid, step_harmonic and step_trapezoid in a parser with the interface of muParser.
template <class Parser>
void define(Parser& parser) {
  parser.DefineFun("step5", step5);
  parser.DefineFun("step_cycloid", step_cycloid);
  parser.DefineFun("step_harmonic", step_harmonic);
  parser.DefineFun("step_trapezoid", step_trapezoid);
}

}  // namespace tisserand::formats::steps

// SPDX-License-Identifier: GPL-3.0-or-later
// Cosine and sine of a turn in the plane.
#pragma once

#include <cmath>

namespace tisserand::mechanism {

/// Cosine `c` and sine `s` of an angle [rad]. Angles up to 0.1, as in steps and elastic rotations, use series that are
/// exact to round-off.
struct Turn {
  double c, s;
  explicit Turn(double angle) {
    const double a2 = angle * angle;
    if (!(a2 <= 0.01)) {
      c = std::cos(angle);
      s = std::sin(angle);
      return;
    }
    c = 1.0 + a2 * (-1.0 / 2 + a2 * (1.0 / 24 + a2 * (-1.0 / 720 + a2 * (1.0 / 40320))));
    s = angle * (1.0 + a2 * (-1.0 / 6 + a2 * (1.0 / 120 + a2 * (-1.0 / 5040 + a2 * (1.0 / 362880)))));
  }
};

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Names that expressions may use besides t: input channels, which are functions of time, and channels of the mechanism.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "mechanism/forces/curve.hpp"

namespace tisserand::mechanism {

/// Input of expressions: a measured or computed history, linear or monotone cubic between its points, constant outside.
struct Input {
  std::string name;
  Curve curve;
  double first = 0.0;
  double last = 0.0;
  std::vector<double> breakpoints;  ///< instants at which the slope jumps

  double operator()(double t) const { return curve(std::clamp(t, first, last)).value; }
};

/// Names that expressions may use besides t: inputs (functions of time) and channels of the mechanism.
struct ExpressionScope {
  std::vector<std::shared_ptr<const Input>> inputs;
  std::vector<std::string> channels;
};

}  // namespace tisserand::mechanism

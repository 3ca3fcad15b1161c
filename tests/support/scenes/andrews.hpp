// SPDX-License-Identifier: GPL-3.0-or-later
// Andrews' squeezing mechanism (Schiehlen 1990; IVP test set, F. Mazzia): seven plane bodies, ten hinges, a spring, a
// motor.
#pragma once

#include <array>
#include <string>

#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support {

/// A body whose centre of mass is at `center` at the start, with world axes.
formats::RigidBodySpec body_at(const std::string& name, double mass, const Eigen::Vector3d& center,
                               const Eigen::Vector3d& principal_inertia);

struct Andrews {
  static constexpr double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, zf = 0.02, zt = 0.04, fa = 0.01421,
                          rr = 0.007, ra = 0.00092, ss = 0.035, sa = 0.01874, sb = 0.01043, sc = 0.018, sd = 0.02,
                          ta = 0.02308, tb = 0.00916, u = 0.04, ua = 0.01228, ub = 0.00449;
  static constexpr double be = -0.0617138900142764496, th = 0.0, ga = 0.455279819163070380, ph = 0.222668390165885884,
                          de = 0.487364979543842550, om = -0.222668390165885884, ep = 1.23054744454982119;
  static constexpr std::array<double, 7> mass{0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498};
  static constexpr std::array<double, 7> inertia{2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5};
  inline static const Eigen::Vector3d A{-0.06934, -0.00227, 0}, B{-0.03635, 0.03273, 0}, C{0.014, 0.072, 0};
};

formats::Scene andrews(double step);

}  // namespace tisserand::test_support

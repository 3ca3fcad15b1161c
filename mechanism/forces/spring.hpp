// SPDX-License-Identifier: GPL-3.0-or-later
// Spring, damper and stops along one coordinate.
#pragma once

#include <optional>
#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/forces/curve.hpp"

namespace tisserand::mechanism {

/// Spring, damper and stops along one joint coordinate q. Its generalised force is
/// Q = −f(q − q_free) − d(q̇) + Q_stop + F(t). A stop that is exceeded by g > 0 pushes back with k_s g (1 + d_s ġ) and
/// never pulls ([HC75] with exponent 1).
struct Spring {
  std::string name;
  int coordinate = 0;     ///< index in Model::coordinates
  Curve stiffness = 0.0;  ///< law f of the spring: k (q − q_free) or a table
  Curve damping = 0.0;    ///< law d of the damper: c q̇ or a table
  double free = 0.0;
  bool free_at_start = false;  ///< `free` is the value at the start
  std::optional<double> lower, upper;
  double stop_stiffness = 0.0;
  double stop_damping = 0.0;  ///< d_s [time/length] or [time/rad]
  formats::TimeFunctionSpec force = 0.0;
  bool has_force = false;
};

/// Generalised force Q of a spring at one instant, with derivatives by q and q̇, energy and power.
struct SpringForce {
  double Q = 0.0;
  double stop = 0.0;  ///< force Q_stop of a stop, included in Q
  double dQ_dq = 0.0;
  double dQ_dqd = 0.0;
  double energy = 0.0;      ///< energy of spring and stops
  double dissipated = 0.0;  ///< power dissipated by damper and stops
};

/// Computes the force of a spring at the coordinate `q` and its rate `qd`. `applied`: F(t).
inline SpringForce spring_force(const Spring& s, double q, double qd, double applied) {
  SpringForce f;
  const Curve::Value elastic = s.stiffness(q - s.free), viscous = s.damping(qd);
  f.Q = applied - elastic.value - viscous.value;
  f.dQ_dq = -elastic.slope;
  f.dQ_dqd = -viscous.slope;
  f.energy = elastic.integral;
  f.dissipated = viscous.value * qd;
  const auto stop = [&](double limit, double side) {
    const double g = side * (q - limit), gd = side * qd;
    if (g <= 0.0) return;
    f.energy += 0.5 * s.stop_stiffness * g * g;
    const double factor = 1.0 + s.stop_damping * gd;
    if (factor <= 0.0) {  // leaves faster than the stop can follow: no contact
      f.dissipated += -s.stop_stiffness * g * gd;
      return;
    }
    const double push = side * s.stop_stiffness * g * factor;
    f.Q -= push;
    f.stop -= push;
    f.dQ_dq -= s.stop_stiffness * factor;
    f.dQ_dqd -= s.stop_stiffness * g * s.stop_damping;
    f.dissipated += s.stop_stiffness * g * s.stop_damping * gd * gd;
  };
  if (s.lower) stop(*s.lower, -1.0);
  if (s.upper) stop(*s.upper, 1.0);
  return f;
}

}  // namespace tisserand::mechanism

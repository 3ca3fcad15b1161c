// SPDX-License-Identifier: GPL-3.0-or-later
// Force of a tyre in its contact patch by comprehensive slip: longitudinal slip, slip angle and camber together.
#pragma once

#include <cmath>

#include "common/math/dual.hpp"
#include "mechanism/tyres/patch.hpp"
#include "mechanism/tyres/slip_law.hpp"

namespace tisserand::mechanism {

/// Reference speed V of slips: the larger of |V_x| (`ahead`) and |Ω R| (`turned`).
template <class T>
T slip_speed(const ComprehensiveSlip& /*law*/, const T& ahead, const T& turned) {
  return real_part(ahead) > real_part(turned) ? ahead : turned;
}

/// Force of the contact patch by comprehensive slip. S_s and S_α are the slips along and across, l and R length of the
/// patch and rolling radius, γ the camber. With the combined slip S = √(S_s² + S_αγ²), S_αγ = S_α + l sin γ/(2 R), μ =
/// μ₀ − (μ₀ − μ₁) min(S, 1) and S_n = √((C_s S_s)² + (C_α S_αγ)²)/(3 μ F_z), l_n = 1 − S_n, where S_n < 1
///   F_x = −C_s S_s l_n² − μ_x F_z q,  F_y = −C_α S_α l_n² − μ_y F_z q − C_γ sin γ l_n²,  q = 1 − 3 l_n² + 2 l_n³
///   M_z = l l_n² (C_α S_α (2 l_n/3 − ½) + 3/2 μ_y F_z S_n²), in the direction of rolling.
/// Else all slides: μ F_z against the slip, M_z = 0. (μ_x, μ_y) = μ (S_s, S_αγ)/S. With S_α alone it is the brush model
/// F_y = μ F_z (3 s − 3 s² + s³), M_z = C_α S_α l (1 − s)³/6, s = C_α S_α/(3 μ F_z).
///
/// Differs from [GN90]: Slips have signs instead of cases. Camber acts only while the tyre rolls, and by the fraction
/// of the patch that adheres, so that no force jumps where sliding begins. The total is never more than μ F_z. The
/// small term of M_z from longitudinal and lateral slip together is omitted.
template <class T>
PatchForce<T> patch_force(const ComprehensiveSlip& law, const PatchSlip<T>& slip) {
  using std::sqrt;
  PatchForce<T> force;
  if (!(real_part(slip.load) > 0.0)) return force;
  const T turning = slip.rolling * slip.rolling * slip.camber_sine;
  const T across = slip.across + slip.length * turning / (2.0 * slip.radius);
  const T adhering_x = law.slip_stiffness * slip.along, adhering_y = law.cornering_stiffness * across;
  const T square = slip.along * slip.along + across * across;
  const double stick = law.friction * slip.friction, slide = law.sliding_friction * slip.friction;
  T l_n(1.0), mu(stick), slide_x(0.0), slide_y(0.0), S_n(0.0);
  if (real_part(square) > 0.0) {
    const T S = sqrt(square);
    mu = stick - (stick - slide) * (real_part(S) < 1.0 ? S : T(1.0));
    const T limit = 3.0 * mu * slip.load;
    const T demand = sqrt(adhering_x * adhering_x + adhering_y * adhering_y);
    slide_x = mu * slip.load * slip.along / S;
    slide_y = mu * slip.load * across / S;
    if (!(real_part(demand) < real_part(limit))) {
      force.x = -slide_x;
      force.y = -slide_y;
      return force;
    }
    S_n = demand / limit;
    l_n = 1.0 - S_n;
  }
  force.adhesion = real_part(l_n);
  const T held = l_n * l_n, slid = S_n * S_n * (3.0 - 2.0 * S_n);  // 1 − 3 l_n² + 2 l_n³
  const T side = law.cornering_stiffness * slip.across;
  force.x = -adhering_x * held - slide_x * slid;
  force.y = -(side + law.camber_stiffness * turning) * held - slide_y * slid;
  force.moment = slip.rolling * slip.length * held * (side * (2.0 * l_n / 3.0 - 0.5) + 1.5 * slide_y * S_n * S_n);
  const T size = force.x * force.x + force.y * force.y, most = mu * slip.load;
  if (real_part(size) > real_part(most) * real_part(most)) {
    const T factor = most / sqrt(size);
    force.x = force.x * factor;
    force.y = force.y * factor;
  }
  return force;
}

}  // namespace tisserand::mechanism

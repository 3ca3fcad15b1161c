// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of the contact patch from its slip, for contacts found in space or in the plane; dual numbers for tangents.
#pragma once

#include <cmath>

#include "common/math/dual.hpp"
#include "mechanism/tyres/comprehensive_slip.hpp"
#include "mechanism/tyres/magic_formula.hpp"
#include "mechanism/tyres/tyre.hpp"

namespace tisserand::mechanism {

/// Penetration over the radius from which the vertical damper acts fully.
inline constexpr double landing = 0.01;
/// Time constant τ of the small mass in the equations of the tread (Tyre), over R₀/v₀.
inline constexpr double lag_share = 1e-6;
/// Damping of tread deflections at low speed: the fraction of the slip velocity over v₀ that acts at standstill, and
/// the speed over v₀ at which it vanishes.
inline constexpr double rocking_share = 0.01, rocking_speed = 10.0;

/// Absolute value of a, for any scalar.
template <class T>
T magnitude(const T& a) {
  return real_part(a) < 0.0 ? T(-a) : a;
}

/// Smooth step of t: 0 below 0, 1 above 1, and between them a cubic without kinks.
template <class T>
T smooth_share(const T& t) {
  if (!(real_part(t) > 0.0)) return T(0.0);
  return real_part(t) < 1.0 ? T(t * t * (3.0 - 2.0 * t)) : T(1.0);
}

/// Smooth sign of t, from −1 to 1, proportional to t near 0.
template <class T>
T smooth_sign(const T& t) {
  if (real_part(magnitude(t)) >= 1.0) return T(real_part(t) < 0.0 ? -1.0 : 1.0);
  return t * (1.5 - 0.5 * t * t);
}

/// Tread deflections u and v of a tyre with their first and second rates at one instant.
template <class T>
struct TreadMotion {
  T u = T(0.0), v = T(0.0), ud = T(0.0), vd = T(0.0), udd = T(0.0), vdd = T(0.0);
};

/// Vertical load of a tyre, not negative. The damping force c δ̇ grows with the penetration δ. `rate`: δ̇. `lying`:
/// factor of the load, 1 or less if the wheel lies on its side.
template <class T>
T vertical_load(const Tyre& tyre, const T& penetration, const T& rate, const T& lying) {
  const T ramp = smooth_share<T>(penetration / (landing * tyre.radius));
  const T load = lying * ((tyre.stiffness + tyre.progressive * penetration) * penetration + tyre.damping * ramp * rate);
  return real_part(load) > 0.0 ? load : T(0.0);
}

/// Energy of the vertical spring of a tyre at a penetration.
inline double spring_energy(const Tyre& tyre, double penetration) {
  return (tyre.stiffness / 2.0 + tyre.progressive * penetration / 3.0) * penetration * penetration;
}

/// Speed V by which slip velocities are divided: `speed`, but below `low` = v₀ a parabola that is v₀/2 at standstill,
/// without a kink.
template <class T>
T regularised(const T& speed, double low) {
  return real_part(speed) < low ? T((speed * speed + low * low) / (2.0 * low)) : speed;
}

/// Effective rolling radius at a penetration δ: R₀ − δ/3, or that of the property file, R₀ − (F_z0/k)(D atan(B k
/// δ/F_z0) + F k δ/F_z0).
template <class T>
T rolling_radius(const Tyre& tyre, const T& penetration) {
  using std::atan;
  const auto* law = std::get_if<MagicFormulaLaw>(&tyre.law);
  if (law == nullptr || (law->p.DREFF == 0.0 && law->p.FREFF == 0.0)) return tyre.radius - penetration / 3.0;
  const double nominal = law->p.FNOMIN / law->p.VERTICAL_STIFFNESS;
  const T rho = penetration / nominal;
  return tyre.radius - nominal * (law->p.DREFF * atan(law->p.BREFF * rho) + law->p.FREFF * rho);
}

/// Slip velocities of the contact before any law of slip, and the speed to which they relate. V_x and V_y are
/// velocities of the contact along and across the wheel, Ω R is that of rolling.
template <class T>
struct ContactSlip {
  T along, across;         ///< slip velocities V_x − Ω R and V_y
  T ahead, turned, speed;  ///< |V_x|, |Ω R|, and the speed V of the law
  T rolling_radius, rolling;
};

/// Computes the slip velocities from the velocities `Vx` and `Vy` of the contact along and across the wheel, and from
/// the spin Ω.
template <class T>
ContactSlip<T> slip_from(const Tyre& tyre, const T& penetration, const T& Vx, const T& Vy, const T& spin) {
  ContactSlip<T> s;
  s.rolling_radius = rolling_radius(tyre, penetration);
  const T roll = spin * s.rolling_radius;
  s.along = Vx - roll;
  s.across = Vy;
  s.ahead = magnitude(Vx);
  s.turned = magnitude(roll);
  s.speed = std::visit([&](const auto& law) { return slip_speed(law, s.ahead, s.turned); }, tyre.law);
  s.rolling = smooth_sign<T>(roll / tyre.low_speed);
  return s;
}

/// Relaxation lengths σ_x and σ_y of a tyre, not below the least value.
template <class T>
RelaxationLengths<T> relaxation_of(const Tyre& tyre, const PatchSlip<T>& slip) {
  RelaxationLengths<T> sigma{T(tyre.relaxation), T(tyre.relaxation)};
  if (const auto* law = std::get_if<MagicFormulaLaw>(&tyre.law)) sigma = relaxation_lengths(*law, slip);
  const double least = least_relaxation * tyre.radius;
  return {magic_formula::at_least(sigma.along, least), magic_formula::at_least(sigma.across, least)};
}

/// Negative rates −u̇ and −v̇ of the tread deflections, by their first-order equations (Tyre).
template <class T>
struct LagRate {
  T along, across;
};

/// Sets the slips of the patch from the tread deflections, and returns the negative rates of the deflections.
template <class T>
LagRate<T> relax(const Tyre& tyre, const ContactSlip<T>& s, const TreadMotion<T>& tread, PatchSlip<T>& slip) {
  const RelaxationLengths<T> sigma = relaxation_of(tyre, slip);
  const T sideways = magnitude(s.across);
  const T V = real_part(s.speed) < real_part(sideways) ? sideways : s.speed;
  const T left = T(1.0) - V / (rocking_speed * tyre.low_speed);
  const T share = real_part(left) > 0.0 ? T((rocking_share / tyre.low_speed) * left * left) : T(0.0);
  slip.along = tread.u / sigma.along + share * s.along;
  slip.across = tread.v / sigma.across + share * s.across;
  return {V / sigma.along * tread.u - s.along, V / sigma.across * tread.v - s.across};
}

/// Negative rates of the tread deflections in the air: deflections decay as if the tyre rolled with at least v₀.
template <class T>
LagRate<T> forget(const Tyre& tyre, const T& spin, const TreadMotion<T>& tread) {
  const T V = magnitude(spin) * tyre.radius + tyre.low_speed;
  const T rate = V / (least_relaxation * tyre.radius);
  return {rate * tread.u, rate * tread.v};
}

/// Forces of the contact patch, slips, and negative rates of the tread. `about_axle` is the moment about the axle on
/// the wheel in addition to that of F_x on the loaded radius.
template <class T>
struct PatchAction {
  PatchForce<T> force;
  T about_axle = T(0.0);
  T slip = T(0.0), slip_angle_tangent = T(0.0);
  LagRate<T> lag{T(0.0), T(0.0)};
};

/// Computes the forces of the contact patch from its slip velocities. `radius`: loaded radius. `camber_sine`: sine of
/// the camber. `friction`: factor of the road.
template <class T>
PatchAction<T> act_in_patch(const Tyre& tyre, const ContactSlip<T>& s, const TreadMotion<T>& tread, const T& load,
                            const T& penetration, const T& radius, const T& camber_sine, double friction) {
  using std::sqrt;
  PatchAction<T> a;
  const T V = regularised<T>(s.speed, tyre.low_speed), R = s.rolling_radius;
  PatchSlip<T> slip{s.along / V, s.across / V, camber_sine, load, sqrt(T(8.0 * tyre.radius * penetration)),
                    R,           s.rolling,    s.ahead};
  slip.friction = friction;
  a.slip_angle_tangent = s.across / regularised<T>(s.ahead, tyre.low_speed);
  if (tyre.relaxes()) {
    a.lag = relax(tyre, s, tread, slip);
    a.slip_angle_tangent = slip.across * V / regularised<T>(s.ahead, tyre.low_speed);
  }
  a.force = std::visit([&](const auto& law) { return patch_force(law, slip); }, tyre.law);
  a.about_axle = -(R - radius) * a.force.x - tyre.rolling_resistance * load * R * s.rolling + a.force.resistance;
  a.slip = -slip.along;
  return a;
}

/// Motion of the tread from its deflections and rates.
inline TreadMotion<double> tread_motion(const Tread& t) {
  return {t.w[0], t.w[1], t.wd[0], t.wd[1], t.wdd[0], t.wdd[1]};
}

/// Motion of the tread with its derivative by deflection k (0: u, 1: v, others: none). The coefficients of a tangent
/// multiply the derivatives of deflections, rates and accelerations.
inline TreadMotion<Dual> tread_motion(const Tread& t, const TangentCoefficients& c, int k) {
  const auto moved = [k](int i, double at, double coefficient) { return Dual(at, i == k ? coefficient : 0.0); };
  return {moved(0, t.w[0], c.stiffness), moved(1, t.w[1], c.stiffness), moved(0, t.wd[0], c.damping),
          moved(1, t.wd[1], c.damping),  moved(0, t.wdd[0], c.mass),    moved(1, t.wdd[1], c.mass)};
}

/// Residual m (ẅ + (ẇ + rate)/τ) of both equations of the tread, w = (u, v). `rate`: negative rates of the first-order
/// equations.
template <class T>
Eigen::Matrix<T, 2, 1> lag_residual(const Tyre& tyre, const TreadMotion<T>& tread, const LagRate<T>& rate) {
  const double m = lag_mass(tyre), tau = lag_share * tyre.radius / tyre.low_speed;
  return {m * tread.udd + m / tau * (tread.ud + rate.along), m * tread.vdd + m / tau * (tread.vd + rate.across)};
}

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Longitudinal and lateral force by the Magic Formula, pure and combined: [Pac12] (4.E1) to (4.E30) and (4.E50) to
// (4.E67). Interpretation, axes and signs are those of magic_formula.hpp.
#pragma once

#include <cmath>

#include "common/math/dual.hpp"
#include "mechanism/tyres/patch.hpp"
#include "mechanism/tyres/slip_law.hpp"

namespace tisserand::mechanism {

namespace magic_formula {

/// Least coefficient of friction. It keeps the stiffness factor B finite if a fit is used beyond its loads.
inline constexpr double least_friction = 1e-3;

template <class T>
double sign(const T& a) {
  return real_part(a) < 0.0 ? -1.0 : 1.0;
}
template <class T>
T absolute(const T& a) {
  return sign(a) * a;
}
/// Value limited to [low, high]; no limits if both are zero.
template <class T>
T within(const T& a, double low, double high) {
  if (low == 0.0 && high == 0.0) return a;
  return real_part(a) < low ? T(low) : real_part(a) > high ? T(high) : a;
}
template <class T>
T at_least(const T& a, double least) {
  return real_part(a) < least ? T(least) : a;
}
/// Value with the given sign and at least `least` in size.
template <class T>
T of_sign(const T& a, double sign, double least) {
  return sign * at_least<T>(sign * a, least);
}
template <class T>
T at_most_one(const T& E) {
  return real_part(E) > 1.0 ? T(1.0) : E;
}
/// Argument B x − E (B x − atan(B x)) of C atan(..) in the Magic Formula.
template <class T>
T curved(const T& B, const T& x, const T& E) {
  using std::atan;
  const T Bx = B * x;
  return Bx - E * (Bx - atan(Bx));
}
/// Magic Formula without its peak factor: sin(C atan(B x − E (B x − atan(B x)))).
template <class T>
T sine_of(const T& B, const T& C, const T& E, const T& x) {
  using std::atan;
  using std::sin;
  return sin(C * atan(curved(B, x, E)));
}
/// Cosine form of the Magic Formula: cos(C atan(B x − E (B x − atan(B x)))).
template <class T>
T cosine_of(const T& B, const T& C, const T& E, const T& x) {
  using std::atan;
  using std::cos;
  return cos(C * atan(curved(B, x, E)));
}

/// Inputs of all formulas at one instant, with the symbols of [Pac12].
template <class T>
struct MagicInput {
  T kappa, alpha, gamma;  ///< κ, α, γ within the ranges of the file
  T Fz, dfz;              ///< load F_z within the range of the file, df_z
  double Fz0, dpi;        ///< scaled nominal load F'_z0, pressure dp_i
  /// Direction of rolling (−1 to 1), and the factor of all shifts, which act only while the wheel rolls (0 at
  /// standstill to 1).
  T rolling, shifts;
  double mu_x, mu_y;  ///< λ_μ: scaling factors times friction of the road
};

template <class T>
MagicInput<T> input_of(const MagicFormulaLaw& law, const PatchSlip<T>& slip, const T& load) {
  using std::atan;
  using std::sqrt;
  const formats::MagicFormula& p = law.p;
  MagicInput<T> in;
  const double side = law.mirrored ? -1.0 : 1.0;
  in.kappa = within<T>(-slip.along, p.KPUMIN, p.KPUMAX);
  in.alpha = within<T>(atan(side * slip.across), p.ALPMIN, p.ALPMAX);
  const T sine = side * slip.camber_sine;
  in.gamma = within<T>(atan(sine / sqrt(T(1.0) - sine * sine)), p.CAMMIN, p.CAMMAX);
  in.Fz = load;
  in.Fz0 = p.LFZO * p.FNOMIN;
  in.dfz = (load - in.Fz0) / in.Fz0;
  in.dpi = law.is_6_1() ? law.pressure : 0.0;
  in.rolling = slip.rolling;
  in.shifts = slip.rolling * slip.rolling;
  in.mu_x = p.LMUX * slip.friction;
  in.mu_y = p.LMUY * slip.friction;
  return in;
}

/// Slip stiffness K_xκ, (4.E15).
template <class T>
T slip_stiffness(const formats::MagicFormula& p, const MagicInput<T>& in) {
  using std::exp;
  const double by_pressure = 1.0 + p.PPX1 * in.dpi + p.PPX2 * in.dpi * in.dpi;
  return in.Fz * (p.PKX1 + p.PKX2 * in.dfz) * exp(p.PKX3 * in.dfz) * (by_pressure * p.LKX);
}

/// Pure longitudinal force F_x0, (4.E9) to (4.E18).
template <class T>
T pure_longitudinal(const formats::MagicFormula& p, const MagicInput<T>& in) {
  const T gamma = p.LGAX * in.gamma;
  const double by_pressure = 1.0 + p.PPX3 * in.dpi + p.PPX4 * in.dpi * in.dpi;
  const T mu = at_least<T>((p.PDX1 + p.PDX2 * in.dfz) * (1.0 - p.PDX3 * gamma * gamma) * (by_pressure * in.mu_x),
                           least_friction);
  const T D = mu * in.Fz, C(p.PCX1 * p.LCX);
  const T kappa = in.kappa + in.shifts * (p.PHX1 + p.PHX2 * in.dfz) * p.LHX;
  const T E =
      at_most_one<T>((p.PEX1 + p.PEX2 * in.dfz + p.PEX3 * in.dfz * in.dfz) * ((1.0 - p.PEX4 * sign(kappa)) * p.LEX));
  const T B = slip_stiffness(p, in) / (C * D);
  const T shift = in.shifts * in.Fz * (p.PVX1 + p.PVX2 * in.dfz) * (p.LVX * in.mu_x);
  return D * sine_of(B, C, E, kappa) + shift;
}

/// Pure lateral force, and its terms that moments and combined slip use too.
template <class T>
struct Lateral {
  T force;       ///< F_y0: pure lateral force
  T K, B, C;     ///< K_yα, B_y, C_y: cornering stiffness and factors
  T mu;          ///< μ_y: peak friction coefficient
  T shift, S_V;  ///< S_Hy, S_Vy: horizontal and vertical shift
};

/// Computes the pure lateral force F_y0, (4.E19) to (4.E30).
template <class T>
Lateral<T> pure_lateral(const MagicFormulaLaw& law, const MagicInput<T>& in) {
  using std::atan;
  using std::sin;
  const formats::MagicFormula& p = law.p;
  const bool new_version = law.is_6_1();
  Lateral<T> y;
  const T gamma = new_version ? in.gamma : T(p.LGAY * in.gamma), square = gamma * gamma;
  const double mu_pressure = 1.0 + p.PPY3 * in.dpi + p.PPY4 * in.dpi * in.dpi;
  y.mu = of_sign<T>((p.PDY1 + p.PDY2 * in.dfz) * (1.0 - p.PDY3 * square) * (mu_pressure * in.mu_y), sign(p.PDY1),
                    least_friction);
  const T D = y.mu * in.Fz;
  y.C = T(p.PCY1 * p.LCY);
  const double four = new_version ? p.PKY4 : 2.0;
  const T peak = new_version ? T((p.PKY2 + p.PKY5 * square) * (1.0 + p.PPY2 * in.dpi)) : T(p.PKY2);
  y.K = p.PKY1 * in.Fz0 * (1.0 + p.PPY1 * in.dpi) * p.LKY * (1.0 - p.PKY3 * absolute(gamma)) *
        sin(four * atan(in.Fz / (in.Fz0 * peak)));
  const T S_H = in.shifts * (p.PHY1 + p.PHY2 * in.dfz) * p.LHY;
  const T S_V = in.shifts * in.Fz * (p.PVY1 + p.PVY2 * in.dfz) * p.LVY * in.mu_y;
  T by_camber = in.shifts * in.Fz * (p.PVY3 + p.PVY4 * in.dfz) * gamma * in.mu_y;
  if (new_version) {
    by_camber = by_camber * p.LKYC;
    const T K_camber = in.Fz * (p.PKY6 + p.PKY7 * in.dfz) * ((1.0 + p.PPY5 * in.dpi) * p.LKYC);
    y.shift = S_H + (in.shifts * K_camber * gamma - by_camber) / y.K;
  } else {
    y.shift = S_H + in.shifts * p.PHY3 * gamma;
  }
  y.S_V = S_V + by_camber;
  const T alpha = in.alpha + y.shift;
  const T by_side = 1.0 + p.PEY5 * square - (p.PEY3 + p.PEY4 * gamma) * sign(alpha);
  const T E = at_most_one<T>((p.PEY1 + p.PEY2 * in.dfz) * by_side * p.LEY);
  y.B = y.K / (y.C * D);
  y.force = D * sine_of(y.B, y.C, E, alpha) + y.S_V;
  return y;
}

/// Weight G_xα of the longitudinal force in combined slip, (4.E51) to (4.E57).
template <class T>
T longitudinal_weight(const MagicFormulaLaw& law, const MagicInput<T>& in) {
  using std::atan;
  using std::cos;
  const formats::MagicFormula& p = law.p;
  const T by_camber = law.is_6_1() ? T(p.RBX1 + p.RBX3 * in.gamma * in.gamma) : T(p.RBX1);
  const T B = by_camber * cos(atan(p.RBX2 * in.kappa)) * p.LXAL, C(p.RCX1);
  const T E = at_most_one<T>(p.REX1 + p.REX2 * in.dfz), shift = in.shifts * p.RHX1;
  return cosine_of<T>(B, C, E, in.alpha + shift) / cosine_of<T>(B, C, E, shift);
}

/// Weight G_yκ and shift S_Vyκ of the lateral force in combined slip, (4.E58) to (4.E67).
template <class T>
struct LateralWeight {
  T G, S_V;
};
template <class T>
LateralWeight<T> lateral_weight(const MagicFormulaLaw& law, const MagicInput<T>& in, const T& mu) {
  using std::atan;
  using std::cos;
  using std::sin;
  const formats::MagicFormula& p = law.p;
  const T by_camber = law.is_6_1() ? T(p.RBY1 + p.RBY4 * in.gamma * in.gamma) : T(p.RBY1);
  const T B = by_camber * cos(atan(p.RBY2 * (in.alpha - p.RBY3))) * p.LYKA, C(p.RCY1);
  const T E = at_most_one<T>(p.REY1 + p.REY2 * in.dfz), shift = in.shifts * (p.RHY1 + p.RHY2 * in.dfz);
  const T D = mu * in.Fz * (p.RVY1 + p.RVY2 * in.dfz + p.RVY3 * in.gamma) * cos(atan(p.RVY4 * in.alpha));
  return {cosine_of<T>(B, C, E, in.kappa + shift) / cosine_of<T>(B, C, E, shift),
          in.shifts * D * sin(p.RVY5 * atan(p.RVY6 * in.kappa)) * p.LVYKA};
}

}  // namespace magic_formula

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Force of a tyre in its contact patch by the Magic Formula, versions 5.2 and 6.1, steady state without turn slip.
//
// Equation numbers are those of [Pac12] section 4.3.2. Property files are fitted for MF-Tyre. Where it differs from
// that book, the code follows MF-Tyre ([BSP10], and what MFeval measured of it): α and γ themselves for α* and γ*, F_z0
// without its scaling factor in trail and arm, QDZ3 with the sign of γ, equivalent slip angles by arctan, λ'_μ = λ_μ.
// 5.2 is that of the manual of PAC2002. Axes and signs are ISO-W, those of property files: κ = −V_sx/|V_x| (driving
// positive), tan α = V_y/|V_x|, γ right-handed about x, so that the cornering stiffness is negative.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanism/tyres/magic_formula_forces.hpp"

namespace tisserand::mechanism {

namespace magic_formula {

/// Overturning moment M_x, (4.E69). Version 5.2 has the first three terms alone. The last three are those of version
/// 6.2. `Fy`: lateral force.
template <class T>
T overturning(const MagicFormulaLaw& law, const MagicInput<T>& in, const T& Fy) {
  using std::atan;
  using std::cos;
  using std::sin;
  const formats::MagicFormula& p = law.p;
  const double R0 = p.UNLOADED_RADIUS, F0 = p.FNOMIN;
  T sum = in.shifts * (p.QSX1 * p.LVMX) - p.QSX2 * in.gamma * (1.0 + p.PPMX1 * in.dpi) + p.QSX3 * Fy / F0;
  if (law.is_6_1()) {
    const T load = p.QSX6 * in.Fz / F0;
    sum += p.QSX4 * cos(p.QSX5 * atan(load * load)) * sin(p.QSX7 * in.gamma + p.QSX8 * atan(p.QSX9 * Fy / F0)) +
           p.QSX10 * atan(p.QSX11 * in.Fz / F0) * in.gamma - p.QSX12 * in.gamma * absolute(in.gamma);
    return R0 * p.LMX * (in.Fz * sum + Fy * (p.QSX13 + p.QSX14 * absolute(in.gamma)));
  }
  return R0 * p.LMX * in.Fz * sum;
}

/// Rolling resistance moment M_y without the sign of rolling, (4.E70). In version 5.2 it has four terms and is
/// proportional to the load.
template <class T>
T rolling_resistance(const MagicFormulaLaw& law, const MagicInput<T>& in, const T& speed, const T& Fx) {
  using std::pow;
  const formats::MagicFormula& p = law.p;
  const T fast = p.LONGVL > 0.0 ? T(speed / p.LONGVL) : T(0.0);
  T sum = p.QSY1 + p.QSY2 * Fx / p.FNOMIN + p.QSY3 * fast + p.QSY4 * fast * fast * fast * fast;
  if (!law.is_6_1()) return p.UNLOADED_RADIUS * p.LMY * in.Fz * sum;
  sum += (p.QSY5 + p.QSY6 * in.Fz / p.FNOMIN) * in.gamma * in.gamma;
  const T by_load = pow(T(in.Fz / p.FNOMIN), p.QSY7);
  return (p.UNLOADED_RADIUS * p.FNOMIN * p.LMY * std::pow(1.0 + in.dpi, p.QSY8)) * sum * by_load;
}

/// Equivalent slip angle of a slip angle and a longitudinal slip, (4.E77), (4.E78). `alpha`: angle from the zero of
/// trail or residual moment. `ratio`: longitudinal slip times K_xκ/K_yα.
template <class T>
T equivalent_angle(const T& alpha, const T& ratio) {
  using std::atan;
  using std::cos;
  using std::sin;
  using std::sqrt;
  if (real_part(ratio) == 0.0) return alpha;
  const T slope = sin(alpha) / cos(alpha);
  return sign(alpha) * atan(sqrt(slope * slope + ratio * ratio));
}

/// Aligning moment M_z, (4.E31) to (4.E49) and (4.E71) to (4.E78). The trail acts on F'_y, which is G_yκ F_y0(γ = 0) in
/// version 6.1 and F_y − S_Vyκ in 5.2.
template <class T>
T aligning(const MagicFormulaLaw& law, const MagicInput<T>& in, const Lateral<T>& y, const T& Fx, const T& Fy,
           const LateralWeight<T>& weight) {
  using std::atan;
  using std::cos;
  const formats::MagicFormula& p = law.p;
  const bool new_version = law.is_6_1();
  const T gamma = new_version ? in.gamma : T(p.LGAZ * in.gamma), square = gamma * gamma;
  const T ratio = slip_stiffness(p, in) / y.K * in.kappa, cosine = cos(in.alpha);
  const double stiff = p.LKY / in.mu_y, R0 = p.UNLOADED_RADIUS;
  const T alpha_t = in.alpha + in.shifts * (p.QHZ1 + p.QHZ2 * in.dfz + (p.QHZ3 + p.QHZ4 * in.dfz) * gamma);
  const T B =
      (p.QBZ1 + p.QBZ2 * in.dfz + p.QBZ3 * in.dfz * in.dfz) * (1.0 + p.QBZ4 * gamma + p.QBZ5 * absolute(gamma)) * stiff;
  const T C(p.QCZ1);
  const T D = in.Fz * (R0 / p.FNOMIN) * (p.QDZ1 + p.QDZ2 * in.dfz) * (1.0 - p.PPZ1 * in.dpi) *
              (1.0 + p.QDZ3 * gamma + p.QDZ4 * square) * p.LTR;
  const T E = at_most_one<T>((p.QEZ1 + p.QEZ2 * in.dfz + p.QEZ3 * in.dfz * in.dfz) *
                             (1.0 + (p.QEZ4 + p.QEZ5 * gamma) * (2.0 / std::numbers::pi) * atan(B * C * alpha_t)));
  const T trail = in.rolling * D * cosine_of<T>(B, C, E, equivalent_angle(alpha_t, ratio)) * cosine;
  T by_camber = (p.QDZ8 + p.QDZ9 * in.dfz) * (1.0 + p.PPZ2 * in.dpi) * gamma;
  if (new_version) by_camber = (by_camber + (p.QDZ10 + p.QDZ11 * in.dfz) * gamma * absolute(gamma)) * p.LKZC;
  const T B_r = p.QBZ9 * stiff + p.QBZ10 * y.B * y.C;
  const T D_r = in.rolling * in.Fz * (R0 * in.mu_y) * ((p.QDZ6 + p.QDZ7 * in.dfz) * p.LRES + by_camber) * cosine;
  const T residual = D_r * cos(atan(B_r * equivalent_angle<T>(in.alpha + y.shift + y.S_V / y.K, ratio)));
  const T arm = (R0 * p.LS) * (in.shifts * p.SSZ1 + p.SSZ2 * Fy / p.FNOMIN + (p.SSZ3 + p.SSZ4 * in.dfz) * in.gamma);
  MagicInput<T> upright = in;
  upright.gamma = T(0.0);
  const T turning = new_version ? T(weight.G * pure_lateral(law, upright).force) : T(Fy - weight.S_V);
  return residual - trail * turning + arm * Fx;
}

}  // namespace magic_formula

/// Reference speed V of slips: |V_x| (`ahead`), but not less than the speed that gives the largest slip of the file.
/// `turned`: |Ω R|.
template <class T>
T slip_speed(const MagicFormulaLaw& law, const T& ahead, const T& turned) {
  const double most = law.p.KPUMAX > 0.0 ? law.p.KPUMAX : 1.5;
  const T least = magic_formula::absolute<T>(ahead - turned) / most;
  return real_part(ahead) < real_part(least) ? least : ahead;
}

/// Force of the contact patch by the Magic Formula. Beyond the loads of the file forces keep their ratio to the load.
template <class T>
PatchForce<T> patch_force(const MagicFormulaLaw& law, const PatchSlip<T>& slip) {
  using namespace magic_formula;
  using formats::MagicFormulaForces;
  using std::sqrt;
  const formats::MagicFormula& p = law.p;
  PatchForce<T> force;
  if (!(real_part(slip.load) > 0.0)) return force;
  // Beyond the loads of the file forces keep their ratio to the load.
  const T load = within(slip.load, p.FZMIN, p.FZMAX);
  const T outside = slip.load / load;
  const MagicInput<T> in = input_of(law, slip, load);
  const bool both = p.forces == MagicFormulaForces::combined;
  if (p.along()) force.x = pure_longitudinal(p, in);
  if (both) force.x = force.x * longitudinal_weight(law, in);
  double used_across = 0.0;
  if (p.across()) {
    const Lateral<T> y = pure_lateral(law, in);
    LateralWeight<T> weight{T(1.0), T(0.0)};
    if (both) weight = lateral_weight(law, in, y.mu);
    force.y = weight.G * y.force + weight.S_V;
    force.overturning = overturning(law, in, force.y);
    MagicInput<T> slipping = in;
    if (!both) slipping.kappa = T(0.0);
    force.moment = aligning<T>(law, slipping, y, both ? force.x : T(0.0), force.y, weight);
    used_across = real_part(force.y) / (real_part(load) * real_part(y.mu));
  }
  if (p.along()) force.resistance = -in.rolling * rolling_resistance(law, in, slip.speed, force.x);
  const double used_along = real_part(force.x) / (real_part(load) * std::max(p.PDX1 * in.mu_x, least_friction));
  force.adhesion = std::max(0.0, 1.0 - std::hypot(used_along, used_across));
  const double side = law.mirrored ? -1.0 : 1.0;
  force.x = outside * force.x;
  force.y = side * outside * force.y;
  force.moment = side * outside * force.moment;
  force.overturning = side * outside * force.overturning;
  force.resistance = outside * force.resistance;
  return force;
}

/// Relaxation lengths σ_κ and σ_α of a property file, along and across the wheel. They follow from carcass stiffnesses
/// (version 6.1, (A3.9)) if the file has them, else from PTX and PTY (5.2). They are 0 if the file has neither.
template <class T>
struct RelaxationLengths {
  T along, across;
};

template <class T>
RelaxationLengths<T> relaxation_lengths(const MagicFormulaLaw& law, const PatchSlip<T>& slip) {
  using namespace magic_formula;
  using std::atan;
  using std::exp;
  using std::sin;
  const formats::MagicFormula& p = law.p;
  const MagicInput<T> in = input_of(law, slip, within(slip.load, p.FZMIN, p.FZMAX));
  RelaxationLengths<T> sigma{T(0.0), T(0.0)};
  const auto carcass = [&](double stiffness, double one, double two, double three) {
    return stiffness * (1.0 + one * in.dfz + two * in.dfz * in.dfz) * (1.0 + three * in.dpi);
  };
  if (p.LONGITUDINAL_STIFFNESS > 0.0)
    sigma.along = absolute<T>(slip_stiffness(p, in) / carcass(p.LONGITUDINAL_STIFFNESS, p.PCFX1, p.PCFX2, p.PCFX3));
  else if (p.PTX1 != 0.0)
    sigma.along = in.Fz * (p.PTX1 + p.PTX2 * in.dfz) * exp(-p.PTX3 * in.dfz) * (p.UNLOADED_RADIUS / p.FNOMIN * p.LSGKP);
  if (p.across() && p.LATERAL_STIFFNESS > 0.0)
    sigma.across = absolute<T>(pure_lateral(law, in).K / carcass(p.LATERAL_STIFFNESS, p.PCFY1, p.PCFY2, p.PCFY3));
  else if (p.PTY1 != 0.0)
    sigma.across = p.PTY1 * sin(2.0 * atan(in.Fz / (p.PTY2 * in.Fz0))) * (1.0 - p.PKY3 * absolute(in.gamma)) *
                   (p.UNLOADED_RADIUS * p.LFZO * p.LSGAL);
  return sigma;
}

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of rotation vectors for the interpolation of beam elements, in addition to common/math/rotation.hpp:
// logarithm and tangents for any scalar, with series that are exact over the angles inside an element.
#pragma once

#include <array>
#include <cmath>

#include "common/math/rotation.hpp"

namespace tisserand::mechanism::beam {

/// Polynomial Σ a_k u^k by Horner's scheme.
template <class S, std::size_t K>
inline S polynomial(const std::array<double, K>& a, const S& u) {
  S sum(a[K - 1]);
  for (std::size_t k = K - 1; k-- > 0;) sum = sum * u + a[k];
  return sum;
}

/// Limit of u = a² [rad²] below which the nine terms of `e_series` are exact to round-off.
inline constexpr double series_limit = 0.25;
/// Coefficients of the series e(u) = Σ |B_2k| u^(k−1)/(2k)! of T⁻¹, THEORY (4), with u = a² and Bernoulli numbers B.
inline constexpr std::array<double, 9> e_series = {1.0 / 12.0,
                                                   1.0 / 720.0,
                                                   1.0 / 30240.0,
                                                   1.0 / 1209600.0,
                                                   1.0 / 47900160.0,
                                                   691.0 / 1307674368000.0,
                                                   1.0 / 74724249600.0,
                                                   3617.0 / 10670622842880000.0,
                                                   43867.0 / 5109094217170944000.0};
/// Coefficients of the series of atan(√z)/√z in powers of z.
inline constexpr std::array<double, 10> atan_series = {1.0,       -1.0 / 3, 1.0 / 5,   -1.0 / 7, 1.0 / 9,
                                                       -1.0 / 11, 1.0 / 13, -1.0 / 15, 1.0 / 17, -1.0 / 19};

/// Rotation vector ψ = log(E) of a rotation E, a = |ψ| ≤ π, with quantities for its variations. w = tan(a/4)/a ψ, so
/// that exp(ψ/2) = 1 + 2 (w~ + w~²)/(1 + w·w). u = a², and e is that of T⁻¹(ψ) = 1 + ψ~/2 + e ψ~², THEORY (4). Below a
/// = 0.5 rad it needs no transcendental function.
template <class S>
struct Logarithm {
  Vec3<S> psi, w;
  S u, e;

  explicit Logarithm(const Mat3<S>& E) {
    using std::sqrt;
    Eigen::Matrix<S, 4, 1> q = quaternion_wxyz(E);
    if (real_part(q[0]) < 0.0) q = -q;
    const S scale = 1.0 / (1.0 + q[0]);
    w = q.template tail<3>() * scale;
    const S w2 = dot3(w, w);
    if (real_part(w2) < 0.0155) {  // tan²(0.5/4) = 0.01579
      psi = w * S(4.0 * polynomial(atan_series, w2));
      u = dot3(psi, psi);
      e = polynomial(e_series, u);
    } else {
      const Vec3<S> v = q.template tail<3>();
      const S n = sqrt(dot3(v, v));
      const S half = atan2_scalar(n, q[0]);
      psi = v * S(2.0 * half / n);
      u = 4.0 * half * half;
      e = (1.0 - half * q[0] / n) / u;
    }
  }
};

/// Product T⁻¹(ψ) a = a + ψ×a/2 + e ψ×(ψ×a) of THEORY (4). `e`: Logarithm::e of ψ. With −ψ for ψ the result is T⁻ᵀ(ψ)
/// a.
template <class S>
inline Vec3<S> inverse_tangent_times(const Vec3<S>& psi, const S& e, const Vec3<S>& a) {
  const Vec3<S> b = cross(psi, a);
  return a + b * S(0.5) + cross(psi, b) * e;
}

/// First ten coefficients of the series Σ (−1)^k u^k/(2k + first)! after `order` applications of 2 d/du.
constexpr std::array<double, 10> curvature_series(int first, int order) {
  std::array<double, 10> a{};
  for (int k = 0; k < 10; ++k) {
    const int power = k + order;
    double value = power % 2 == 0 ? 1.0 : -1.0;
    for (int i = 2; i <= 2 * power + first; ++i) value /= i;
    for (int i = 0; i < order; ++i) value *= 2.0 * (power - i);
    a[k] = value;
  }
  return a;
}
inline constexpr std::array<double, 10> c_series = curvature_series(2, 0), c1_series = curvature_series(2, 1),
                                        c2_series = curvature_series(2, 2), d_series = curvature_series(3, 0),
                                        d1_series = curvature_series(3, 1), d2_series = curvature_series(3, 2);

/// Functions of u = a² for an angle a: s = sin(a)/a, c = (1 − cos a)/a², d = (a − sin a)/a³. c1 = 2 dc/du and c2 = 2
/// dc1/du are derivatives, and so are d1 and d2 of d. For u = φ·φ the gradient of c is c1 φ. Uses series below u = 1
/// and closed forms above.
template <class S>
struct CurvatureFunctions {
  S s, c, d, c1, d1;

  explicit CurvatureFunctions(const S& u) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    if (real_part(u) < 1.0) {
      c = polynomial(c_series, u);
      d = polynomial(d_series, u);
      c1 = polynomial(c1_series, u);
      d1 = polynomial(d1_series, u);
      s = 1.0 - u * d;
    } else {
      const S a = sqrt(u);
      const S sine_half = sin(0.5 * a);
      s = sin(a) / a;
      c = 2.0 * sine_half * sine_half / u;
      d = (1.0 - s) / u;
      c1 = (s - 2.0 * c) / u;
      d1 = (c - 3.0 * d) / u;
    }
  }
  S c2(const S& u) const { return real_part(u) < 1.0 ? polynomial(c2_series, u) : (d - c - 4.0 * c1) / u; }
  S d2(const S& u) const { return real_part(u) < 1.0 ? polynomial(d2_series, u) : (c1 - 5.0 * d1) / u; }
};

/// Product T(φ) a = a − c φ×a + d φ×(φ×a) of THEORY (3). `f`: functions c and d of u = φ·φ. With −φ for φ the result is
/// Tᵀ(φ) a.
template <class S>
inline Vec3<S> tangent_times(const Vec3<S>& phi, const CurvatureFunctions<S>& f, const Vec3<S>& a) {
  const Vec3<S> b = cross(phi, a);
  return a - b * f.c + cross(phi, b) * f.d;
}

/// Gradient of m · T(φ) a by φ: −c k − c1 A φ + d ∇B + d1 B φ with k = a×m, A = φ·k, B = (φ·a)(φ·m) − u a·m. `u` = φ·φ,
/// and `f` holds the functions of u.
template <class S>
inline Vec3<S> tangent_gradient(const Vec3<S>& phi, const S& u, const CurvatureFunctions<S>& f, const Vec3<S>& a,
                                const Vec3<S>& m) {
  const Vec3<S> k = cross(a, m);
  const S am = dot3(a, m), pa = dot3(phi, a), pm = dot3(phi, m);
  const S along = f.d1 * (pa * pm - u * am) - f.c1 * dot3(phi, k) - 2.0 * f.d * am;
  return k * S(-f.c) + (a * pm + m * pa) * f.d + phi * along;
}

}  // namespace tisserand::mechanism::beam

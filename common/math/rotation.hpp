// SPDX-License-Identifier: GPL-3.0-or-later
// Rotations: skew matrices, exponential, logarithm and their tangents on SO(3), for every scalar that kernels use.
//
// Conventions (CONVENTIONS.md): R maps body axes to world axes; increments are material (right): δR = R skew(δΘ),
// Ṙ = R skew(Ω). Source key [Car00] with the corrections of docs/THEORY.md, sections 3 to 5.
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/math/dual.hpp"

namespace tisserand {

template <class S>
using Vec3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Mat3 = Eigen::Matrix<S, 3, 3>;

/// Matrix skew(a) = a~ of the cross product: skew(a) b = a × b.
template <class S>
Mat3<S> skew(const Vec3<S>& a) {
  Mat3<S> m;
  m << S(0), -a.z(), a.y(), a.z(), S(0), -a.x(), -a.y(), a.x(), S(0);
  return m;
}

/// Cross product a × b without conjugation, valid for complex scalars.
template <class S>
Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

/// Scalar product a · b without conjugation, valid for complex scalars.
template <class S>
S dot3(const Vec3<S>& a, const Vec3<S>& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

/// The functions of the angle a (given a²) from which exp, T and T⁻¹ are built:
/// s = sin a / a, c = (1 − cos a)/a², d = (a − sin a)/a³, e = 1/a² − 1/(2 a tan(a/2)).
/// Taylor series below a² = 1e-2 (relative error < 1e-16 there), closed forms above.
template <class S>
struct AngleFunctions {
  S s, c, d, e;
  explicit AngleFunctions(const S& a2) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    if (real_part(a2) < 1e-2) {
      s = 1.0 - a2 / 6.0 * (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0 * (1.0 - a2 / 72.0 * (1.0 - a2 / 110.0))));
      c = 0.5 * (1.0 - a2 / 12.0 * (1.0 - a2 / 30.0 * (1.0 - a2 / 56.0 * (1.0 - a2 / 90.0 * (1.0 - a2 / 132.0)))));
      d = 1.0 / 6.0 *
          (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0 * (1.0 - a2 / 72.0 * (1.0 - a2 / 110.0 * (1.0 - a2 / 156.0)))));
      e = 1.0 / 12.0 +
          a2 * (1.0 / 720.0 +
                a2 * (1.0 / 30240.0 + a2 * (1.0 / 1209600.0 + a2 * (1.0 / 47900160.0 + a2 * (691.0 / 1307674368000.0 +
                                                                                             a2 / 74724249600.0)))));
    } else {
      const S a = sqrt(a2);
      const S sine_half = sin(0.5 * a);
      s = sin(a) / a;
      c = 2.0 * sine_half * sine_half / a2;
      d = (1.0 - s) / a2;
      e = (1.0 - 0.5 * s / c) / a2;
    }
  }
};

/// Rotation matrix of the rotation vector ψ: exp(ψ~) = 1 + s ψ~ + c ψ~² with ψ~ = skew(ψ) and s, c of AngleFunctions at
/// |ψ|.
template <class S>
Mat3<S> exp_so3(const Vec3<S>& psi) {
  const AngleFunctions<S> f(dot3(psi, psi));
  const Mat3<S> P = skew(psi);
  return Mat3<S>::Identity() + f.s * P + f.c * (P * P);
}

/// Tangent T(ψ) = 1 − c ψ~ + d ψ~² of the rotation vector, with ψ~ = skew(ψ) and c, d of AngleFunctions. δΘ = T(ψ) δψ
/// is the material increment of exp(ψ~).
template <class S>
Mat3<S> tangent_so3(const Vec3<S>& psi) {
  const AngleFunctions<S> f(dot3(psi, psi));
  const Mat3<S> P = skew(psi);
  return Mat3<S>::Identity() - f.c * P + f.d * (P * P);
}

/// Inverse of tangent_so3(): T⁻¹(ψ) = 1 + ψ~/2 + e ψ~² with ψ~ = skew(ψ) and e of AngleFunctions. It is valid for |ψ| <
/// 2π. T⁻¹(−ψ) = T⁻ᵀ(ψ).
template <class S>
Mat3<S> inverse_tangent_so3(const Vec3<S>& psi) {
  const AngleFunctions<S> f(dot3(psi, psi));
  const Mat3<S> P = skew(psi);
  return Mat3<S>::Identity() + 0.5 * P + f.e * (P * P);
}

/// Unit quaternion [w, x, y, z] of a rotation matrix by the largest of four pivots (Shepperd 1978), which loses no
/// digits at any angle. Real parts choose the pivot of complex and dual scalars.
template <class S>
Eigen::Matrix<S, 4, 1> quaternion_wxyz(const Mat3<S>& R) {
  using std::sqrt;
  const S trace = R(0, 0) + R(1, 1) + R(2, 2);
  Eigen::Matrix<S, 4, 1> q;
  int pivot = -1;
  double largest = real_part(trace);
  for (int i = 0; i < 3; ++i)
    if (real_part(R(i, i)) > largest) {
      largest = real_part(R(i, i));
      pivot = i;
    }
  if (pivot < 0) {
    const S r = sqrt(1.0 + trace);
    q[0] = 0.5 * r;
    const S f = 0.5 / r;
    q[1] = (R(2, 1) - R(1, 2)) * f;
    q[2] = (R(0, 2) - R(2, 0)) * f;
    q[3] = (R(1, 0) - R(0, 1)) * f;
  } else {
    const int i = pivot, j = (i + 1) % 3, k = (i + 2) % 3;
    const S r = sqrt(1.0 + R(i, i) - R(j, j) - R(k, k));
    const S f = 0.5 / r;
    q[1 + i] = 0.5 * r;
    q[0] = (R(k, j) - R(j, k)) * f;
    q[1 + j] = (R(j, i) + R(i, j)) * f;
    q[1 + k] = (R(k, i) + R(i, k)) * f;
  }
  return q;
}

/// Rotation vector ψ of the rotation matrix R: exp(skew(ψ)) = R and |ψ| ≤ π. It is accurate at every angle (computed
/// from the quaternion).
template <class S>
Vec3<S> log_so3(const Mat3<S>& R) {
  using std::sqrt;
  Eigen::Matrix<S, 4, 1> q = quaternion_wxyz(R);
  if (real_part(q[0]) < 0.0) q = -q;
  const Vec3<S> v = q.template tail<3>();
  const S n2 = dot3(v, v);
  if (real_part(n2) < 1e-6) {
    // ψ = 2 v (atan(n/w)/n), series of atan(x)/x with x = n/w.
    const S x2 = n2 / (q[0] * q[0]);
    return v * (2.0 / q[0] * (1.0 - x2 * (1.0 / 3.0 - x2 * (1.0 / 5.0 - x2 * (1.0 / 7.0 - x2 / 9.0)))));
  }
  const S n = sqrt(n2);
  return v * (2.0 * atan2_scalar(n, q[0]) / n);
}

}  // namespace tisserand

// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation vectors by T(ψ)⁻¹ and its closed gradient; swing and twist by dual numbers on the quaternion.
#include "mechanism/forces/relative_turn.hpp"

#include <cmath>

#include "common/math/rotation.hpp"
#include "mechanism/joints/coordinate.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Derivative ∂(w + s/2 ψ × w + e ψ × (ψ × w))/∂ψ, of T(ψ)⁻¹ w for s = 1, of T(ψ)⁻ᵀ w for s = −1.
Matrix3d inverse_tangent_gradient(const Vector3d& psi, const Vector3d& w, double s) {
  const AngleFunctions<Dual> f(Dual(psi.squaredNorm(), 1.0));  // e and its derivative by |ψ|²
  const double along = psi.dot(w);
  const Vector3d twice = psi * along - w * psi.squaredNorm();
  Matrix3d G = -0.5 * s * skew<double>(w);
  G += f.e.value * (along * Matrix3d::Identity() + psi * w.transpose() - 2.0 * w * psi.transpose());
  G += 2.0 * f.e.derivative * twice * psi.transpose();
  return G;
}

template <class S>
using Quaternion = Eigen::Matrix<S, 4, 1>;

/// Function h(s²) = 2 asin(s)/s and its derivative by s², for the sine s of half the swing.
template <class S>
struct SwingFunctions {
  S h, slope;
  SwingFunctions(const S& s2, const S& c2) {
    using std::sqrt;
    if (real_part(s2) < 1e-2) {
      // 2 Σ a_n s²ⁿ, a_n = (2n)!/(4ⁿ n!² (2n+1)): the ninth term is below 1e-17.
      h = S(0.0);
      slope = S(0.0);
      double binomial = 1.0;  // (2n)!/(4ⁿ n!²)
      S power(1.0), before(0.0);
      for (int n = 0; n < 9; ++n) {
        const double a = 2.0 * binomial / (2.0 * n + 1.0);
        h += a * power;
        if (n > 0) slope += (a * n) * before;
        before = power;
        power *= s2;
        binomial *= (2.0 * n + 1.0) / (2.0 * n + 2.0);
      }
    } else {
      const S s = sqrt(s2), c = sqrt(c2), half = atan2_scalar(s, c);
      h = 2.0 * half / s;
      slope = (1.0 / c - half / s) / s2;
    }
  }
};

/// Matrix B of swing and twist about axis k.
template <class S>
Mat3<S> swing_twist_rates(const Quaternion<S>& q, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const S w = q[0];
  const Vec3<S> v = q.template tail<3>();
  Mat3<S> rate = S(0.5) * skew<S>(v);  // v̇ = ½(w ω + v × ω), ẇ = −½ v·ω
  for (int m = 0; m < 3; ++m) rate(m, m) = S(0.5) * w;
  const S c2 = w * w + v[k] * v[k];
  const SwingFunctions<S> f(v[i] * v[i] + v[j] * v[j], c2);
  Mat3<S> B;
  for (int m = 0; m < 3; ++m) {
    B(k, m) = (2.0 * w * rate(k, m) + v[k] * v[m]) / c2;
    const S growth = 2.0 * f.slope * (v[i] * rate(i, m) + v[j] * rate(j, m));
    B(i, m) = f.h * rate(i, m) + growth * v[i];
    B(j, m) = f.h * rate(j, m) + growth * v[j];
  }
  return B;
}

/// Derivative ∂B/∂Θ_m of swing and twist.
Matrix3d rates_along(const Eigen::Vector4d& q, int axis, int m) {
  const Vector3d v = q.tail<3>(), e = Vector3d::Unit(m), dv = 0.5 * (q[0] * e + v.cross(e));
  Quaternion<Dual> moved;
  moved[0] = Dual(q[0], -0.5 * v[m]);
  for (int i = 0; i < 3; ++i) moved[1 + i] = Dual(v[i], dv[i]);
  return swing_twist_rates<Dual>(moved, axis).unaryExpr([](const Dual& x) { return x.derivative; });
}

}  // namespace

RelativeTurn::RelativeTurn(const Matrix3d& R, int axis, double near) : axis_(axis) {
  if (axis < 0) {
    q_.setZero();
    psi_ = log_so3<double>(R);
    B_ = inverse_tangent_so3<double>(psi_);
    return;
  }
  q_ = quaternion_wxyz<double>(R);
  const double twist = unwrapped(2.0 * std::atan2(q_[1 + axis], q_[0]), near);
  if (std::cos(0.5 * twist) * q_[0] + std::sin(0.5 * twist) * q_[1 + axis] < 0.0) q_ = -q_;
  psi_ = q_.tail<3>();
  psi_[axis] = 0.0;
  psi_ *= SwingFunctions<double>(psi_.squaredNorm(), q_[0] * q_[0] + q_[1 + axis] * q_[1 + axis]).h;
  psi_[axis] = twist;
  B_ = swing_twist_rates<double>(q_, axis);
}

Matrix3d RelativeTurn::rate_gradient(const Vector3d& omega) const {
  if (axis_ < 0) return inverse_tangent_gradient(psi_, omega, 1.0) * B_;
  Matrix3d gradient;
  for (int m = 0; m < 3; ++m) gradient.col(m) = rates_along(q_, axis_, m) * omega;
  return gradient;
}

Matrix3d RelativeTurn::moment_gradient(const Vector3d& w) const {
  if (axis_ < 0) return inverse_tangent_gradient(psi_, w, -1.0) * B_;
  Matrix3d gradient;
  for (int m = 0; m < 3; ++m) gradient.col(m) = rates_along(q_, axis_, m).transpose() * w;
  return gradient;
}

}  // namespace tisserand::mechanism

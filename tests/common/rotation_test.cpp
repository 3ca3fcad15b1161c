// SPDX-License-Identifier: GPL-3.0-or-later
// Rotations: every function against long double over all magnitudes of the angle, identities of exp, log and T,
// derivatives.
#include "common/math/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace tisserand::rotation_test {
namespace {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Complex = std::complex<double>;
using Wide = long double;

constexpr double eps = std::numeric_limits<double>::epsilon();
const double pi = std::acos(-1.0);

/// Angles from 1e-12 to `largest`, twenty per decade, and both sides of the switches of rotation.hpp: |ψ| = 0.1 (a² <
/// 1e-2) and half angle with sin² = 1e-6 (log).
std::vector<double> sweep(double largest) {
  std::vector<double> angles;
  for (double exponent = -12.0; std::pow(10.0, exponent) < largest; exponent += 0.05)
    angles.push_back(std::pow(10.0, exponent));
  for (const double centre : {0.1, 2.0 * std::asin(1e-3)})
    for (const double offset : {-1e-3, -1e-9, -1e-15, 0.0, 1e-15, 1e-9, 1e-3})
      angles.push_back(centre * (1.0 + offset));
  for (const double gap : {0.5, 0.1, 1e-2, 1e-3}) angles.push_back(largest - gap);
  return angles;
}

std::vector<Vector3> directions() {
  std::vector<Vector3> list{Vector3::UnitX(), -Vector3::UnitY(), Vector3::UnitZ(), Vector3(1, 1, 1).normalized()};
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 12; ++i) list.push_back(Vector3(normal(random), normal(random), normal(random)).normalized());
  return list;
}

/// Σ_k (−1)^k a^(2k)/(2k + first)!: sin a/a, (1 − cos a)/a², (a − sin a)/a³ for first = 1, 2, 3. Below a = 1 the
/// largest term is the first, so that the sum has all digits of long double.
Wide alternating_series(Wide a, int first) {
  Wide term = 1.0L / std::tgamma(static_cast<Wide>(first) + 1.0L), sum = 0.0L;
  for (int k = 0; k < 40; ++k) {
    sum += term;
    term *= -a * a / (static_cast<Wide>(2 * k + first + 1) * static_cast<Wide>(2 * k + first + 2));
  }
  return sum;
}

struct WideFunctions {
  Wide s, c, d, e;
};

/// e = (1 − s/(2c))/a² = (2c − s)/(2 c a²), and with c = 1/2 − a² f, f = Σ (−1)^k a^(2k)/(2k + 4)!: 2c − s = a² (d −
/// 2f).
WideFunctions wide_functions(Wide a) {
  if (a >= 1.0L) {
    const Wide s = std::sin(a) / a, c = (1.0L - std::cos(a)) / (a * a);
    return {s, c, (1.0L - s) / (a * a), (1.0L - 0.5L * s / c) / (a * a)};
  }
  const Wide s = alternating_series(a, 1), c = alternating_series(a, 2), d = alternating_series(a, 3);
  const Wide fourth = alternating_series(a, 4);  // (c − 1/2)/(−a²)
  return {s, c, d, (d - 2.0L * fourth) / (2.0L * c)};
}

Matrix3 wide_polynomial(const Vector3& psi, Wide first, Wide second) {
  Eigen::Matrix<Wide, 3, 3> P = skew<double>(psi).cast<Wide>();
  return (Eigen::Matrix<Wide, 3, 3>::Identity() + first * P + second * (P * P)).cast<double>();
}

TEST(Rotation, FunctionsOfTheAngleHaveNoLossAtAnyMagnitude) {
  for (const double a : sweep(2 * pi)) {
    const AngleFunctions<double> f(a * a);
    const WideFunctions w = wide_functions(static_cast<Wide>(a));
    // s, c a², d a², e a² are what enters exp, T and T⁻¹ beside 1: errors of a few roundings of 1, or of e a² itself
    // where it grows towards 2π (there tan(a/2) multiplies the rounding of a by |e a²|).
    const double growth = std::max(1.0, std::abs(static_cast<double>(w.e) * a * a));
    EXPECT_NEAR(f.s, static_cast<double>(w.s), 4 * eps) << a;
    EXPECT_NEAR(f.c * a * a, static_cast<double>(w.c) * a * a, 8 * eps) << a;
    EXPECT_NEAR(f.d * a * a, static_cast<double>(w.d) * a * a, 4 * eps) << a;
    EXPECT_NEAR(f.e * a * a, static_cast<double>(w.e) * a * a, 8 * eps * growth * growth) << a;
    if (a < 0.1) {  // the series: all digits
      EXPECT_NEAR(f.c / static_cast<double>(w.c), 1.0, 4 * eps) << a;
      EXPECT_NEAR(f.d / static_cast<double>(w.d), 1.0, 4 * eps) << a;
      EXPECT_NEAR(f.e / static_cast<double>(w.e), 1.0, 4 * eps) << a;
    }
  }
}

TEST(Rotation, ExponentialAndTangentAgreeWithLongDouble) {
  for (const double a : sweep(2 * pi))
    for (const Vector3& n : directions()) {
      const Vector3 psi = a * n;
      const WideFunctions w = wide_functions(std::sqrt(psi.cast<Wide>().squaredNorm()));
      EXPECT_LT((exp_so3<double>(psi) - wide_polynomial(psi, w.s, w.c)).cwiseAbs().maxCoeff(), 16 * eps) << a;
      EXPECT_LT((tangent_so3<double>(psi) - wide_polynomial(psi, -w.c, w.d)).cwiseAbs().maxCoeff(), 16 * eps) << a;
    }
}

TEST(Rotation, ExponentialIsARotation) {
  for (const double a : sweep(2 * pi))
    for (const Vector3& n : directions()) {
      const Matrix3 R = exp_so3<double>(a * n);
      EXPECT_LT((R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff(), 16 * eps) << a;
      EXPECT_NEAR(R.determinant(), 1.0, 16 * eps) << a;
      EXPECT_LT((R * n - n).norm(), 16 * eps) << a;
    }
}

TEST(Rotation, LogarithmInvertsTheExponential) {
  for (const double a : sweep(pi))
    for (const Vector3& n : directions()) {
      const Vector3 psi = a * n;
      // Rounding of R by eps turns by eps: absolute error of a few eps, and relative where R holds ψ to first order.
      EXPECT_LT((log_so3<double>(exp_so3<double>(psi)) - psi).norm(), 16 * eps * std::max(a, std::min(1.0, a * 16)))
          << a;
    }
}

TEST(Rotation, LogarithmNearHalfATurnKeepsItsDigits) {
  for (double exponent = 0.0; exponent > -16.0; exponent -= 0.25) {
    const double a = pi - std::pow(10.0, exponent);
    for (const Vector3& n : directions()) {
      const Matrix3 R = exp_so3<double>(a * n);
      const Vector3 psi = log_so3<double>(R);
      EXPECT_LE(psi.norm(), pi * (1 + 2 * eps));
      // Within rounding of π both signs stand for the same rotation.
      const double error = std::min((psi - a * n).norm(), (psi + (2 * pi - a) * n).norm());
      EXPECT_LT(error, 64 * eps) << a;
      EXPECT_LT((exp_so3<double>(psi) - R).cwiseAbs().maxCoeff(), 64 * eps) << a;
    }
  }
}

TEST(Rotation, QuaternionHasUnitLengthAndTheSameRotation) {
  for (const double a : sweep(2 * pi))
    for (const Vector3& n : directions()) {
      const Matrix3 R = exp_so3<double>(a * n);
      const Eigen::Vector4d q = quaternion_wxyz<double>(R);
      EXPECT_NEAR(q.norm(), 1.0, 16 * eps) << a;
      const Matrix3 back = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
      EXPECT_LT((back - R).cwiseAbs().maxCoeff(), 32 * eps) << a;
    }
}

TEST(Rotation, IdentitiesOfTheTangent) {
  for (const double a : sweep(2 * pi))
    for (const Vector3& n : directions()) {
      const Vector3 psi = a * n;
      const Matrix3 T = tangent_so3<double>(psi), T_inverse = inverse_tangent_so3<double>(psi),
                    R = exp_so3<double>(psi);
      const double size = std::max(1.0, T_inverse.norm());  // grows as 1/(2π − a)
      EXPECT_LT((T * T_inverse - Matrix3::Identity()).cwiseAbs().maxCoeff(), 32 * eps * size * size) << a;
      EXPECT_LT((inverse_tangent_so3<double>(-psi) - T_inverse.transpose()).norm(), 8 * eps * size) << a;
      EXPECT_LT((T_inverse * R.transpose() - inverse_tangent_so3<double>(-psi)).norm(), 64 * eps * size * size) << a;
      EXPECT_LT((R * T - T.transpose()).norm(), 64 * eps) << a;  // T(−ψ) = R T = Tᵀ
      EXPECT_LT((T * psi - psi).norm(), 16 * eps * a) << a;
    }
}

template <class S>
S with_derivative(double value, double derivative, double step);
template <>
Dual with_derivative<Dual>(double value, double derivative, double) {
  return {value, derivative};
}
template <>
Complex with_derivative<Complex>(double value, double derivative, double step) {
  return {value, step * derivative};
}
double derivative_of(const Dual& x, double) { return x.derivative; }
double derivative_of(const Complex& x, double step) { return x.imag() / step; }

/// h² is far below eps for values and derivatives of order 1, h above underflow in products.
constexpr double step = 1e-30;

template <class S>
Vec3<S> along(const Vector3& value, const Vector3& derivative) {
  Vec3<S> v;
  for (int i = 0; i < 3; ++i) v[i] = with_derivative<S>(value[i], derivative[i], step);
  return v;
}

template <class M>
Eigen::MatrixXd derivatives(const M& m) {
  Eigen::MatrixXd d(m.rows(), m.cols());
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) d(i, j) = derivative_of(m(i, j), step);
  return d;
}

TEST(Rotation, DerivativeOfTheExponentialIsTheTangentByDualAndComplex) {
  const std::vector<Vector3> all = directions();
  for (const double a : sweep(2 * pi))
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vector3 psi = a * all[i], d_psi = all[(i + 5) % all.size()];
      const Matrix3 expected = exp_so3<double>(psi) * skew<double>(tangent_so3<double>(psi) * d_psi);
      const Matrix3 dual = derivatives(exp_so3<Dual>(along<Dual>(psi, d_psi)));
      const Matrix3 complex = derivatives(exp_so3<Complex>(along<Complex>(psi, d_psi)));
      // The closed forms differentiate c = 2 sin²(a/2)/a² at a ≥ 0.1: rounding of c is multiplied by 2/a ≤ 20 and |ψ~²|
      // ≤ a².
      EXPECT_LT((dual - expected).cwiseAbs().maxCoeff(), 64 * eps) << a;
      EXPECT_LT((complex - expected).cwiseAbs().maxCoeff(), 64 * eps) << a;
      EXPECT_LT((dual - complex).cwiseAbs().maxCoeff(), 64 * eps) << a;
    }
}

TEST(Rotation, DerivativeOfTheLogarithmIsTheInverseTangentByDualAndComplex) {
  const std::vector<Vector3> all = directions();
  for (const double a : sweep(pi))
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vector3 psi = a * all[i], d_theta = all[(i + 5) % all.size()];
      const Vector3 expected = inverse_tangent_so3<double>(psi) * d_theta;
      const auto rotation = [&]<class S>(S) -> Mat3<S> {
        const Matrix3 R = exp_so3<double>(psi), dR = R * skew<double>(d_theta);
        Mat3<S> m;
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) m(r, c) = with_derivative<S>(R(r, c), dR(r, c), step);
        return m;
      };
      const Vector3 dual = derivatives(log_so3<Dual>(rotation(Dual{})));
      const Vector3 complex = derivatives(log_so3<Complex>(rotation(Complex{})));
      EXPECT_LT((dual - expected).norm(), 128 * eps) << a;
      EXPECT_LT((complex - expected).norm(), 128 * eps) << a;
    }
}

TEST(Rotation, DerivativeOfTheTangentAgreesBetweenDualAndComplexAcrossTheSwitch) {
  const std::vector<Vector3> all = directions();
  for (const double a : sweep(2 * pi - 0.5))
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vector3 psi = a * all[i], d_psi = all[(i + 3) % all.size()];
      const auto difference = [&](const auto& dual, const auto& complex) {
        return (derivatives(dual) - derivatives(complex)).cwiseAbs().maxCoeff();
      };
      // (1 − s)/a² and (1 − s/(2c))/a² lose eps/a² when they are differentiated: at most 1e2 × 2/a × a² there.
      const double scale = 400 * eps * std::max(1.0, inverse_tangent_so3<double>(psi).squaredNorm());
      EXPECT_LT(
          difference(tangent_so3<Dual>(along<Dual>(psi, d_psi)), tangent_so3<Complex>(along<Complex>(psi, d_psi))),
          scale)
          << a;
      EXPECT_LT(difference(inverse_tangent_so3<Dual>(along<Dual>(psi, d_psi)),
                           inverse_tangent_so3<Complex>(along<Complex>(psi, d_psi))),
                scale)
          << a;
      // T T⁻¹ = 1 differentiated: T' = −T (T⁻¹)' T, an independent value for both.
      const Matrix3 T = tangent_so3<double>(psi);
      const Matrix3 dT = derivatives(tangent_so3<Dual>(along<Dual>(psi, d_psi)));
      const Matrix3 dTi = derivatives(inverse_tangent_so3<Dual>(along<Dual>(psi, d_psi)));
      EXPECT_LT((dT + T * dTi * T).cwiseAbs().maxCoeff(), 4 * scale) << a;
    }
}

TEST(Dual, ArithmeticFollowsTheRulesOfDifferentiation) {
  const double x = 0.7, h = 1.0;
  const Dual d(x, h);
  EXPECT_DOUBLE_EQ((d * d * d).derivative, 3 * x * x);
  EXPECT_DOUBLE_EQ((1.0 / d).derivative, -1 / (x * x));
  EXPECT_DOUBLE_EQ((d / (1.0 + d)).derivative, 1 / ((1 + x) * (1 + x)));
  EXPECT_DOUBLE_EQ(sqrt(d).derivative, 0.5 / std::sqrt(x));
  EXPECT_DOUBLE_EQ((sin(d) * cos(d)).derivative, std::cos(2 * x));
  EXPECT_DOUBLE_EQ(atan2(d, Dual(2.0)).derivative, 2.0 / (4.0 + x * x));
  EXPECT_DOUBLE_EQ(atan2(Dual(2.0), d).derivative, -2.0 / (4.0 + x * x));
  Dual y = d;
  y /= y;
  EXPECT_DOUBLE_EQ(y.value, 1.0);
  EXPECT_DOUBLE_EQ(y.derivative, 0.0);
  y = d;
  y *= y;
  EXPECT_DOUBLE_EQ(y.derivative, 2 * x);
}

}  // namespace
}  // namespace tisserand::rotation_test

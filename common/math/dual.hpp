// SPDX-License-Identifier: GPL-3.0-or-later
// Forward dual number with one derivative, and the scalar functions that kernels need for double, Dual and complex.
#pragma once

#include <cmath>
#include <complex>

#include <Eigen/Core>

namespace tisserand {

/// Dual number value + derivative ε with ε² = 0. A kernel that is a template on its scalar returns exact derivatives if
/// this is the scalar.
struct Dual {
  double value = 0.0;
  double derivative = 0.0;

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT(google-explicit-constructor): constants mix with duals in formulas
  Dual(double v, double d) : value(v), derivative(d) {}

  Dual& operator+=(const Dual& b) {
    value += b.value;
    derivative += b.derivative;
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    value -= b.value;
    derivative -= b.derivative;
    return *this;
  }
  Dual& operator*=(const Dual& b) {
    derivative = derivative * b.value + value * b.derivative;
    value *= b.value;
    return *this;
  }
  Dual& operator/=(const Dual& b) {
    value /= b.value;
    derivative = (derivative - value * b.derivative) / b.value;
    return *this;
  }
};

inline Dual operator-(const Dual& a) { return {-a.value, -a.derivative}; }
inline Dual operator+(Dual a, const Dual& b) { return a += b; }
inline Dual operator-(Dual a, const Dual& b) { return a -= b; }
inline Dual operator*(Dual a, const Dual& b) { return a *= b; }
inline Dual operator/(Dual a, const Dual& b) { return a /= b; }
inline bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
inline bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
inline bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
inline bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
inline bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
inline bool operator!=(const Dual& a, const Dual& b) { return a.value != b.value; }

inline Dual sqrt(const Dual& a) {
  const double r = std::sqrt(a.value);
  return {r, 0.5 * a.derivative / r};
}
inline Dual sin(const Dual& a) { return {std::sin(a.value), std::cos(a.value) * a.derivative}; }
inline Dual cos(const Dual& a) { return {std::cos(a.value), -std::sin(a.value) * a.derivative}; }
inline Dual atan(const Dual& a) { return {std::atan(a.value), a.derivative / (1.0 + a.value * a.value)}; }
inline Dual exp(const Dual& a) {
  const double e = std::exp(a.value);
  return {e, e * a.derivative};
}
/// Power of a dual number, for a > 0.
inline Dual pow(const Dual& a, double exponent) {
  const double power = std::pow(a.value, exponent);
  return {power, exponent * power / a.value * a.derivative};
}
inline Dual atan2(const Dual& y, const Dual& x) {
  const double n = x.value * x.value + y.value * y.value;
  return {std::atan2(y.value, x.value), (x.value * y.derivative - y.value * x.derivative) / n};
}

inline double real_part(double a) { return a; }
inline double real_part(const Dual& a) { return a.value; }
inline double real_part(const std::complex<double>& a) { return a.real(); }
inline long double real_part(long double a) { return a; }

inline double atan2_scalar(double y, double x) { return std::atan2(y, x); }
inline long double atan2_scalar(long double y, long double x) { return std::atan2(y, x); }
inline Dual atan2_scalar(const Dual& y, const Dual& x) { return atan2(y, x); }
/// atan2 of complex numbers with the small imaginary parts of a complex step: atan2 of the real parts plus its first
/// derivative.
inline std::complex<double> atan2_scalar(const std::complex<double>& y, const std::complex<double>& x) {
  const double n = x.real() * x.real() + y.real() * y.real();
  return {std::atan2(y.real(), x.real()), (x.real() * y.imag() - y.real() * x.imag()) / n};
}

}  // namespace tisserand

namespace Eigen {
template <>
struct NumTraits<tisserand::Dual> : NumTraits<double> {
  using Real = tisserand::Dual;
  using NonInteger = tisserand::Dual;
  using Nested = tisserand::Dual;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 2,
    MulCost = 4
  };
};
template <typename BinaryOp>
struct ScalarBinaryOpTraits<tisserand::Dual, double, BinaryOp> {
  using ReturnType = tisserand::Dual;
};
template <typename BinaryOp>
struct ScalarBinaryOpTraits<double, tisserand::Dual, BinaryOp> {
  using ReturnType = tisserand::Dual;
};
}  // namespace Eigen

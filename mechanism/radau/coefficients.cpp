// SPDX-License-Identifier: GPL-3.0-or-later
// Values of the coefficients.
#include "mechanism/radau/coefficients.hpp"

#include <cmath>

#include <Eigen/LU>

namespace tisserand::mechanism::radau {
namespace {

Coefficients make() {
  const double r = std::sqrt(6.0);
  Coefficients m;
  m.c << (4.0 - r) / 10.0, (4.0 + r) / 10.0, 1.0;
  m.A << (88.0 - 7.0 * r) / 360.0, (296.0 - 169.0 * r) / 1800.0, (-2.0 + 3.0 * r) / 225.0, (296.0 + 169.0 * r) / 1800.0,
      (88.0 + 7.0 * r) / 360.0, (-2.0 - 3.0 * r) / 225.0,  //
      (16.0 - r) / 36.0, (16.0 + r) / 36.0, 1.0 / 9.0;
  m.inverse = m.A.inverse();
  // Eigenvalues and eigenvectors as in RADAU5 of Hairer and Wanner.
  const double a = std::cbrt(9.0), b = std::cbrt(81.0);
  const double alpha = (12.0 - b + a) / 60.0, beta = (b + a) * std::sqrt(3.0) / 60.0,
               square = alpha * alpha + beta * beta;
  m.gamma = 30.0 / (6.0 + b - a);
  m.pair = {alpha / square, beta / square};
  m.T << 0.091232394870892942792, -0.14125529502095420843, -0.030029194105147424492,  //
      0.24171793270710701896, 0.20412935229379993199, 0.38294211275726193779,         //
      0.96604818261509293619, 1.0, 0.0;
  m.T_inverse = m.T.inverse();
  m.e << (-13.0 - 7.0 * r) / (3.0 * m.gamma), (-13.0 + 7.0 * r) / (3.0 * m.gamma), -1.0 / (3.0 * m.gamma);
  return m;
}

}  // namespace

const Coefficients& coefficients() {
  static const Coefficients method = make();
  return method;
}

}  // namespace tisserand::mechanism::radau

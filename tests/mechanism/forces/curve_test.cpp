// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of springs as tables: values, slopes and integrals against known functions.
#include "mechanism/forces/curve.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace tisserand::mechanism::curve_test {
namespace {

using formats::CurveSpec;
using formats::Interpolation;

// Integral from 0 by Simpson's rule on 2000 intervals: exact for cubics, and the kinks lie on its points.
double simpson(const Curve& curve, double x) {
  constexpr int n = 2000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double a = x * i / n, b = x * (i + 1) / n;
    sum += (b - a) / 6.0 * (curve(a).value + 4.0 * curve(0.5 * (a + b)).value + curve(b).value);
  }
  return sum;
}

TEST(Curve, ANumberIsProportional) {
  const Curve::Value v = Curve(3.0)(-2.0);
  EXPECT_EQ(v.value, -6.0);
  EXPECT_EQ(v.slope, 3.0);
  EXPECT_EQ(v.integral, 6.0);
}

TEST(Curve, LinearTablesAreStraightBetweenAndBeyond) {
  const Curve curve(CurveSpec{Interpolation::linear, {-1.0, 1.0, 2.0}, {-4.0, 0.0, 6.0}});
  EXPECT_DOUBLE_EQ(curve(0.5).value, -1.0);
  EXPECT_DOUBLE_EQ(curve(1.5).value, 3.0);
  EXPECT_DOUBLE_EQ(curve(1.5).slope, 6.0);
  EXPECT_DOUBLE_EQ(curve(-3.0).value, -8.0);
  EXPECT_DOUBLE_EQ(curve(4.0).value, 18.0);
  EXPECT_DOUBLE_EQ(curve(0.0).integral, 0.0);
  EXPECT_DOUBLE_EQ(curve(-1.0).integral, 3.0);  // ∫₋₁⁰ of 2x − 2 is −3
  for (const double x : {-4.0, 2.0, 6.0}) EXPECT_NEAR(curve(x).integral, simpson(curve, x), 1e-11) << x;
}

// At 2 and 3 the data are not monotone: slope zero, so no value leaves the range of its two points. By hand: secants
// 1, 3, −2 with h = 1: slope at 1 by [FB84]: 1·3/(½·3 + ½·1) = 1.5.
TEST(Curve, CubicTablesDoNotOvershoot) {
  const Curve curve(CurveSpec{Interpolation::cubic, {0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, 4.0, 2.0}});
  EXPECT_DOUBLE_EQ(curve(1.0).slope, 1.5);
  EXPECT_DOUBLE_EQ(curve(2.0).slope, 0.0);
  EXPECT_DOUBLE_EQ(curve(0.0).slope, 0.75);  // (3·1 − 1.5)/2
  const double h = 1e-4;
  for (double x = -0.5; x < 3.6; x += 0.0371) {
    const Curve::Value v = curve(x);
    EXPECT_LE(v.value, 4.0);
    // Truncation h²·y'''/6 < 1e-7; the grid misses the points of the table by more than h.
    EXPECT_NEAR(v.slope, (curve(x + h).value - curve(x - h).value) / (2 * h), 1e-6);
    EXPECT_NEAR(v.value, (curve(x + h).integral - curve(x - h).integral) / (2 * h), 1e-7);
  }
  EXPECT_NEAR(curve(3.0).integral, simpson(curve, 3.0), 1e-8);
}

// sin x on a grid: in the middle of its rise the slope of [FB84] errs by O(h²), the values by O(h³) or better; halving
// the spacing quarters the error at least.
TEST(Curve, CubicTablesConverge) {
  const auto error = [](int n) {
    CurveSpec table{Interpolation::cubic, {}, {}};
    for (int i = 0; i <= n; ++i) {
      table.x.push_back(-1.2 + 2.4 * i / n);
      table.y.push_back(std::sin(table.x.back()));
    }
    const Curve curve(table);
    double largest = 0.0;
    for (double x = -0.8; x < 0.8; x += 0.013) largest = std::max(largest, std::abs(curve(x).value - std::sin(x)));
    return largest;
  };
  EXPECT_LT(error(16), 1e-3);
  EXPECT_LT(error(32), error(16) / 4.0);
}

}  // namespace
}  // namespace tisserand::mechanism::curve_test

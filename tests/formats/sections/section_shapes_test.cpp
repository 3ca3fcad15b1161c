// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the section constants of shapes against integrals over the section and limits.
#include "formats/sections/shapes.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace tisserand::formats::section_shapes_test {
namespace {

/// Area and ∫z² dA of a section that is symmetric about z = 0 with width b(z), |z| <= h, by the midpoint rule with n
/// strips (error of order n^-1.5 where b falls like a square root, else n^-2 or one strip at a jump).
struct Integrals {
  double area = 0.0, second_moment = 0.0;
};

Integrals integrate(const std::function<double(double)>& width, double h) {
  constexpr int n = 200'000;
  const double dz = h / n;
  Integrals result;
  for (int i = 0; i < n; ++i) {
    const double z = (i + 0.5) * dz, strip = width(z) * dz;
    result.area += 2.0 * strip;
    result.second_moment += 2.0 * z * z * strip;
  }
  return result;
}

void expect_equal(const Section& section, const Integrals& along_z, const Integrals& along_y) {
  constexpr double tolerance = 2e-5;
  EXPECT_NEAR(section.area / along_z.area, 1.0, tolerance);
  EXPECT_NEAR(section.second_moment_y / along_z.second_moment, 1.0, tolerance);
  EXPECT_NEAR(section.second_moment_z / along_y.second_moment, 1.0, tolerance);
  EXPECT_DOUBLE_EQ(section.polar_moment, section.second_moment_y + section.second_moment_z);
}

TEST(SectionShapes, Circle) {
  const double r = 0.3;
  const Integrals integrals = integrate([&](double z) { return 2.0 * std::sqrt(r * r - z * z); }, r);
  const Section section = circle_section(r);
  expect_equal(section, integrals, integrals);
  EXPECT_DOUBLE_EQ(section.torsion_constant, 0.5 * M_PI * std::pow(r, 4));
  EXPECT_DOUBLE_EQ(section.shear_area_y, 6.0 / 7.0 * M_PI * r * r);
}

TEST(SectionShapes, HollowCircle) {
  for (const double t : {0.02, 0.1, 0.15, 0.25}) {
    const double r = 0.3, inner = r - t;
    const Integrals integrals = integrate(
        [&](double z) {
          return 2.0 * (std::sqrt(r * r - z * z) - (z < inner ? std::sqrt(inner * inner - z * z) : 0.0));
        },
        r);
    const Section section = hollow_circle_section(r, t);
    SCOPED_TRACE(t);
    expect_equal(section, integrals, integrals);
    EXPECT_DOUBLE_EQ(section.torsion_constant, section.second_moment_y + section.second_moment_z);
  }
  // Limits: A/2 for a thin tube (shear flow S = R²t cos θ in both walls, I = πR³t, A_s = I²/∫S²/t ds = πRt), and the
  // solid circle.
  const Section thin = hollow_circle_section(1.0, 1e-4), thick = hollow_circle_section(1.0, 1.0 - 1e-6);
  EXPECT_NEAR(thin.shear_area_y / thin.area, 0.5, 1e-8);
  EXPECT_NEAR(thick.shear_area_y / thick.area, 6.0 / 7.0, 1e-10);
}

TEST(SectionShapes, Rectangle) {
  const double w = 0.2, h = 0.5;
  const Section section = rectangle_section(w, h);
  expect_equal(section, integrate([&](double) { return w; }, 0.5 * h), integrate([&](double) { return h; }, 0.5 * w));
  EXPECT_DOUBLE_EQ(section.second_moment_y, w * h * h * h / 12.0);
  EXPECT_DOUBLE_EQ(section.shear_area_y, 5.0 / 6.0 * w * h);
}

/// Saint-Venant's series expanded along the other side converges to the same constant: a law that no slip in one of the
/// two survives. Its terms do not fall as fast for a < b, hence the many.
double torsion_by_the_other_side(double w, double h) {
  const auto a = static_cast<long double>(std::max(w, h)), b = static_cast<long double>(std::min(w, h));
  long double sum = 0.0L;
  for (int n = 200'001; n >= 1; n -= 2) sum += std::tanh(n * M_PIl * b / (2.0L * a)) / powl(n, 5);
  return static_cast<double>(a * a * a * b / 3.0L * (1.0L - 192.0L / powl(M_PIl, 5) * a / b * sum));
}

TEST(SectionShapes, TorsionOfRectangles) {
  for (const double h : {1.0, 1.3, 2.0, 5.0})
    EXPECT_NEAR(rectangle_section(1.0, h).torsion_constant / torsion_by_the_other_side(1.0, h), 1.0, 1e-10) << h;
  EXPECT_DOUBLE_EQ(rectangle_section(2.0, 5.0).torsion_constant, rectangle_section(5.0, 2.0).torsion_constant);
  // Timoshenko and Goodier, Theory of Elasticity, 3rd ed., section 109, table of k1: J = k1 a³ b, printed to 3 or 4
  // digits.
  EXPECT_NEAR(rectangle_section(1.0, 1.0).torsion_constant, 0.1406, 5e-5);
  EXPECT_NEAR(rectangle_section(1.0, 2.0).torsion_constant / 2.0, 0.229, 5e-4);
  EXPECT_NEAR(rectangle_section(1.0, 10.0).torsion_constant / 10.0, 0.312, 5e-4);
}

/// A_s/A = I²/(A ∫S²/t ds) of a thin box under shear along `depth`, from the shear flow S t: it grows from the middle
/// of the flange to the corner, S = y h/2 · t, and on to the middle of the web, S = (b h/4 + (h²/4 − z²)/2) t. Simpson
/// is exact for the first and the midpoint rule has an error of n^-2 for the second.
double shear_factor_from_flow(double h, double b) {
  constexpr int n = 10'000;
  double energy = 4.0 * (h * h / 4.0) * (b * b * b / 24.0);
  for (int i = 0; i < n; ++i) {
    const double z = 0.5 * h * (i + 0.5) / n, flow = b * h / 4.0 + 0.5 * (h * h / 4.0 - z * z);
    energy += 4.0 * flow * flow * 0.5 * h / n;
  }
  const double second_moment = h * h * h / 6.0 + 0.5 * b * h * h;
  return second_moment * second_moment / energy / (2.0 * (b + h));
}

TEST(SectionShapes, HollowRectangle) {
  for (const double t : {0.01, 0.03, 0.09}) {
    const double w = 0.2, h = 0.5;
    const Section section = hollow_rectangle_section(w, h, t);
    SCOPED_TRACE(t);
    expect_equal(section, integrate([&](double z) { return z > 0.5 * h - t ? w : 2.0 * t; }, 0.5 * h),
                 integrate([&](double y) { return y > 0.5 * w - t ? h : 2.0 * t; }, 0.5 * w));
    EXPECT_NEAR(section.shear_area_z / section.area, shear_factor_from_flow(h - t, w - t), 1e-7);
    EXPECT_NEAR(section.shear_area_y / section.area, shear_factor_from_flow(w - t, h - t), 1e-7);
  }
  // Bredt for a thin square tube of middle side 1 and wall t: J = 4 A² t / s = t.
  EXPECT_NEAR(hollow_rectangle_section(1.001, 1.001, 1e-3).torsion_constant, 1e-3, 1e-15);
}

}  // namespace
}  // namespace tisserand::formats::section_shapes_test

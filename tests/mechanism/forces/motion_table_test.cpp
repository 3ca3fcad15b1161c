// SPDX-License-Identifier: GPL-3.0-or-later
// Motions from tables: no overshoot, holds, two continuous derivatives, orders on smooth data; smooth steps.
#include "mechanism/forces/motion_table.hpp"

#include <cmath>
#include <functional>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "mechanism/forces/motion_function.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::motion_table_test {
namespace {

using formats::TableMotion;
using formats::TimeExpression;
using formats::TimeTable;
using Function = std::function<double(double)>;

constexpr double eps = 2.3e-16;

/// Spacings over two decades, rises over four, a fifth of them 0.
TimeTable random_table(std::mt19937& random, bool monotone) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  TimeTable table;
  double t = -1.0, y = 0.3;
  const int points = 2 + static_cast<int>(random() % 12);
  for (int i = 0; i < points; ++i) {
    table.time.push_back(t);
    table.value.push_back(y);
    t += std::pow(10.0, -2.0 * u(random));
    const double rise = u(random) < 0.2 ? 0.0 : std::pow(10.0, -4.0 * u(random));
    y += !monotone && u(random) < 0.5 ? -rise : rise;
  }
  return table;
}

// Between any two points the motion stays between them and never turns; equal points are held with exactly no rate.
// Round-off: values are of size 10 at most, the control points of a quintic add up ten terms of the size of its rise.
TEST(MotionTable, NeverOvershootsAndHolds) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 4000; ++trial) {
    const TimeTable table = random_table(random, trial % 2 == 0);
    const MotionTable f(table);
    for (std::size_t i = 0; i + 1 < table.time.size(); ++i) {
      const double a = table.time[i], h = table.time[i + 1] - a, rise = table.value[i + 1] - table.value[i];
      const double low = std::min(table.value[i], table.value[i + 1]), high = low + std::abs(rise);
      for (int k = 0; k < 100; ++k) {
        const MotionValue v = f(a + h * k / 100.0);
        ASSERT_GE(v.value, low - 40.0 * eps) << trial;
        ASSERT_LE(v.value, high + 40.0 * eps) << trial;
        ASSERT_GE((rise < 0.0 ? -v.rate : v.rate) * h, -100.0 * eps * std::abs(rise) - 20.0 * eps * h) << trial;
        if (rise != 0.0) continue;
        ASSERT_EQ(v.value, low);
        ASSERT_EQ(v.rate, 0.0);
        ASSERT_EQ(v.acceleration, 0.0);
      }
    }
  }
}

// Just before a point and at it. The differences h² of accelerations are sums of a dozen rounded terms of the rise,
// which the neighbours' spacings (100 times longer at most) make 1e4 times larger at most.
TEST(MotionTable, HasTwoContinuousDerivatives) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    const TimeTable table = random_table(random, trial % 2 == 0);
    const MotionTable f(table);
    for (std::size_t i = 1; i + 1 < table.time.size(); ++i) {
      const double t = table.time[i], h = std::min(t - table.time[i - 1], table.time[i + 1] - t);
      const MotionValue before = f(std::nextafter(t, -9.0)), at = f(t);
      EXPECT_NEAR(before.value, at.value, 1e-11);
      EXPECT_NEAR(h * before.rate, h * at.rate, 1e-11);
      EXPECT_NEAR(h * h * before.acceleration, h * h * at.acceleration, 1e-11);
    }
  }
}

// Central differences of order two: errors d²/6 of the third derivative of value and rate, which the data bound.
TEST(MotionTable, DerivativesAreThoseOfTheValue) {
  for (const TableMotion kind : {TableMotion::smooth, TableMotion::natural}) {
    const MotionTable f(TimeTable{{0.0, 0.5, 1.2, 2.0, 2.3, 3.0}, {0.0, 0.1, 0.7, 0.7, 0.2, -0.4}, kind});
    const double d = 1e-4;
    for (double t = -0.5; t < 3.5; t += 0.0137) {
      const MotionValue v = f(t), ahead = f(t + d), behind = f(t - d);
      EXPECT_NEAR(v.rate, (ahead.value - behind.value) / (2.0 * d), 1e-5) << t;
      if (std::abs(t) < d || std::abs(t - 3.0) < d) continue;
      EXPECT_NEAR(v.acceleration, (ahead.rate - behind.rate) / (2.0 * d), 1e-2) << t;
    }
  }
}

struct Errors {
  double value = 0.0, rate = 0.0, acceleration = 0.0;
};

Errors errors_of(int intervals, const Function& y, const Function& yd, const Function& ydd) {
  TimeTable table;
  for (int i = 0; i <= intervals; ++i) {
    table.time.push_back(static_cast<double>(i) / intervals);
    table.value.push_back(y(table.time.back()));
  }
  const MotionTable f(table);
  Errors worst;
  for (int k = 0; k <= 5000; ++k) {
    const double t = k / 5000.0;
    const MotionValue v = f(t);
    worst.value = std::max(worst.value, std::abs(v.value - y(t)));
    worst.rate = std::max(worst.rate, std::abs(v.rate - yd(t)));
    worst.acceleration = std::max(worst.acceleration, std::abs(v.acceleration - ydd(t)));
  }
  return worst;
}

// Five-point rates err by h⁴ and accelerations by h³, a Hermite quintic through exact ones by h⁶: orders 5, 4, 3; also
// where the data turn on a point.
TEST(MotionTable, OrdersOnSmoothData) {
  const double w = 2.0 * 3.14159265358979323846;
  const auto check = [](const Function& y, const Function& yd, const Function& ydd) {
    const Errors coarse = errors_of(80, y, yd, ydd), fine = errors_of(160, y, yd, ydd);
    EXPECT_NEAR(std::log2(coarse.value / fine.value), 5.0, 0.15);
    EXPECT_NEAR(std::log2(coarse.rate / fine.rate), 4.0, 0.15);
    EXPECT_NEAR(std::log2(coarse.acceleration / fine.acceleration), 3.0, 0.15);
  };
  check([](double t) { return std::exp(2 * t); }, [](double t) { return 2 * std::exp(2 * t); },
        [](double t) { return 4 * std::exp(2 * t); });
  check([=](double t) { return std::cos(w * t); }, [=](double t) { return -w * std::sin(w * t); },
        [=](double t) { return -w * w * std::cos(w * t); });
}

// A turn between two points is cut off: no value beyond the data. The cut is w² h²/8 at most, the rate w² h/2.
TEST(MotionTable, TurnsBetweenPointsAreCutOff) {
  const double w = 2.0 * 3.14159265358979323846, phase = 0.7;
  const auto y = [=](double t) { return std::cos(w * t + phase); };
  for (const int n : {40, 80, 160, 320}) {
    const Errors e = errors_of(
        n, y, [=](double t) { return -w * std::sin(w * t + phase); },
        [=](double t) { return -w * w * std::cos(w * t + phase); });
    const double h = 1.0 / n;
    EXPECT_LE(e.value, w * w * h * h / 8.0);
    EXPECT_LE(e.rate, 0.75 * w * w * h);
    EXPECT_LE(e.acceleration, 3.0 * w * w);
  }
}

TEST(MotionTable, PolynomialsOfDegreeFourAreMet) {
  const auto y = [](double t) { return 1.0 + t + 0.5 * t * t + 0.2 * t * t * t + 0.1 * t * t * t * t; };
  TimeTable table{{0.0, 0.3, 0.5, 1.1, 1.3, 2.0}, {}};
  for (const double t : table.time) table.value.push_back(y(t));
  const MotionTable f(table);
  for (double t = 0.0; t < 2.0; t += 0.07) {
    EXPECT_NEAR(f(t).value, y(t), 1e-13);
    EXPECT_NEAR(f(t).rate, 1.0 + t + 0.6 * t * t + 0.4 * t * t * t, 1e-12);
    EXPECT_NEAR(f(t).acceleration, 1.0 + 1.2 * t + 1.2 * t * t, 1e-11);
  }
  const MotionTable line(TimeTable{{0.0, 2.0}, {1.0, 5.0}});
  EXPECT_DOUBLE_EQ(line(0.5).value, 2.0);
  EXPECT_DOUBLE_EQ(line(-1.0).value, -1.0);
  EXPECT_DOUBLE_EQ(line(3.0).rate, 2.0);
}

// Natural cubic spline of y = |t| at -1, 0, 1: y = 3/2 t^2 - 1/2 t^3 for t > 0, straight on outside.
TEST(MotionTable, NaturalSplinesByChoice) {
  const MotionTable f(TimeTable{{-1, 0, 1}, {1, 0, 1}, TableMotion::natural});
  for (const double t : {0.0, 0.3, 0.9, 1.0}) {
    const MotionValue v = f(t);
    EXPECT_NEAR(v.value, 1.5 * t * t - 0.5 * t * t * t, 1e-14);
    EXPECT_NEAR(v.rate, 3 * t - 1.5 * t * t, 1e-14);
    EXPECT_NEAR(v.acceleration, 3 - 3 * t, 1e-14);
  }
  EXPECT_NEAR(f(3.0).value, 1.0 + 1.5 * 2.0, 1e-14);
  EXPECT_NEAR(f(3.0).rate, 1.5, 1e-14);
  EXPECT_EQ(f(3.0).acceleration, 0.0);
}

TEST(MotionTable, LinearByChoice) {
  const MotionTable f(TimeTable{{0, 1, 3}, {1, 0, 4}, TableMotion::linear});
  EXPECT_DOUBLE_EQ(f(0.25).value, 0.75);
  EXPECT_DOUBLE_EQ(f(2.0).value, 2.0);
  EXPECT_DOUBLE_EQ(f(2.0).rate, 2.0);
  EXPECT_EQ(f(2.0).acceleration, 0.0);
}

// A turntable that a table turns by half a radian and then holds: it stands, from the first step of the hold on. The
// natural spline of the same points swings about the hold by 5 % of the turn at first.
TEST(MotionTable, WhatATableHoldsStands) {
  const auto largest_rate = [](TableMotion kind) {
    formats::Scene scene = test_support::empty_scene(0.01, 2.0);
    scene.bodies.push_back(test_support::rigid_body("table", 2.0, {0.1, 0, 0}, {0.1, 0.1, 0.1}));
    scene.joints.push_back(test_support::joint("hinge", formats::JointKind::revolute, "ground", "table", {0, 0, 0},
                                               Eigen::Vector3d::UnitZ()));
    formats::MotionSpec drive;
    drive.name = "drive";
    drive.coordinate.name = "hinge";
    drive.value = TimeTable{{0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0}, {0, 0, 0, 0.25, 0.5, 0.5, 0.5, 0.5}, kind};
    scene.motions.push_back(drive);
    test_support::Simulation run(scene, {});
    run.start();
    double largest = 0.0;
    for (const auto& [begin, end] : {std::pair{0.0, 0.4}, {0.8, 2.0}})
      for (double t = begin; t < end - 1e-9; t += 0.01) {
        run.run(t + 0.01);
        if (t > begin + 0.015) largest = std::max(largest, run.Omega("table").norm());
      }
    return largest;
  };
  EXPECT_LT(largest_rate(TableMotion::smooth), 1e-9);
  EXPECT_GT(largest_rate(TableMotion::natural), 1e-2);
}

struct Step {
  std::string name, tail;
  double middle;  ///< value a quarter of the way, of a step from 0 to 1
  double rate;    ///< halfway, in mean rates
};

// Values by hand: s = 1/4. step5: 10/64 - 15/256 + 6/1024. Cycloid: 1/4 - 1/2π. Harmonic: (1 - cos(π/4))/2. Trapezoid
// with f = 1/4: s²/(2 f (1 - f)). Rates halfway: 15/8, 2, π/2, 1/(1 - f).
TEST(Steps, ValuesRatesAndEnds) {
  for (const Step& step : {Step{"step5", "", 0.103515625, 1.875},
                           {"step_cycloid", "", 0.25 - 0.5 / M_PI, 2.0},
                           {"step_harmonic", "", 0.5 - 0.5 * std::sqrt(0.5), 0.5 * M_PI},
                           {"step_trapezoid", ", 0.25", 1.0 / 6.0, 4.0 / 3.0}}) {
    // From 2 at t = 1 to -1 at t = 5.
    MotionFunction f(TimeExpression{step.name + "(t, 1, 2, 5, -1" + step.tail + ")", {}, ""}, 1e-2);
    EXPECT_EQ(f(0.3).value, 2.0) << step.name;
    EXPECT_EQ(f(0.3).rate, 0.0) << step.name;
    EXPECT_EQ(f(7.0).value, -1.0) << step.name;
    EXPECT_NEAR(f(2.0).value, 2.0 - 3.0 * step.middle, 1e-14) << step.name;
    EXPECT_NEAR(f(4.0).value, -1.0 + 3.0 * step.middle, 1e-14) << step.name;
    EXPECT_NEAR(f(3.0).rate, -0.75 * step.rate, 1e-10) << step.name;
    EXPECT_NEAR(f(3.0).acceleration, 0.0, 1e-10) << step.name;
  }
}

// Differences of order six are exact for these polynomials, but for round-off: 1e-16 · 3/d and · 10/d² of a value 3.
TEST(Steps, DerivativesOfPolynomialStepsAreExact) {
  MotionFunction f(TimeExpression{"step5(t, 1, 2, 5, -1)", {}, ""}, 1e-2);
  for (const double t : {1.1, 2.0, 2.9, 3.3, 4.7}) {
    const double s = (t - 1.0) / 4.0;
    EXPECT_NEAR(f(t).rate, -0.75 * 30.0 * s * s * (1 - s) * (1 - s), 1e-12);
    EXPECT_NEAR(f(t).acceleration, -3.0 / 16.0 * 60.0 * s * (1 - s) * (1 - 2 * s), 2e-10);
  }
  MotionFunction g(TimeExpression{"step_trapezoid(t, 0, 0, 2, 3, 0.25)", {}, ""}, 1e-2);
  EXPECT_NEAR(g(0.2).acceleration, 3.0 / (0.25 * 0.75 * 4.0), 1e-10);
  EXPECT_NEAR(g(1.0).rate, 2.0, 1e-12);
  EXPECT_NEAR(g(1.8).acceleration, -4.0, 1e-10);
}

// Where the second or third derivative jumps, steps of the integrator end.
TEST(Steps, ConstantTimesAreBreakpoints) {
  const TimeFunction f(TimeExpression{"2*step5(t, 1/2, 0, 2, 1) + step_trapezoid(t, 2, 0, 4, 1, 0.25)", {}, ""});
  EXPECT_EQ(f.breakpoints(), (std::vector<double>{0.5, 2.0, 2.0, 4.0, 2.5, 3.5}));
  EXPECT_TRUE(TimeFunction(TimeExpression{"step5(2*t, 1, 0, 2, 1)", {}, ""}).breakpoints().empty());
}

TEST(Steps, ConstantArgumentsOutOfRangeAreErrors) {
  const auto error = [](const std::string& text) -> std::string {
    try {
      TimeFunction f(TimeExpression{text, {}, "scene.yaml:7:3"}, {});
      return "";
    } catch (const Error& fault) {
      return fault.what();
    }
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(error("2*step5(t, 2, 0, 1, 5)"),
              ::testing::AllOf(HasSubstr("step5: its end t1 = 1 must be later than its start t0 = 2"),
                               HasSubstr("scene.yaml:7:3")));
  EXPECT_THAT(error("step_cycloid(t, 1, 0, 2/2, 5)"), HasSubstr("step_cycloid: its end t1 = 2/2"));
  EXPECT_THAT(error("step5(t, 0, step_harmonic(t, 1, 0, 0.5, 1), 1, 5)"), HasSubstr("step_harmonic: its end"));
  EXPECT_THAT(error("step_trapezoid(t, 0, 0, 1, 5, 0.7)"), HasSubstr("the share 0.7 of the time"));
  EXPECT_THAT(error("step_trapezoid(t, 0, 0, 1, 5, 0)"), HasSubstr("the share 0 of the time"));
  EXPECT_THAT(error("step5(t, 0, 0, 1)"), HasSubstr("arameter"));  // of muParser
  EXPECT_EQ(error("step5(t, 0, 0, 1 + t*t, 5)"), "");
}

}  // namespace
}  // namespace tisserand::mechanism::motion_table_test

// SPDX-License-Identifier: GPL-3.0-or-later
// A run against a reference that has other instants.
#include "mechanism/histories/difference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/thrown.hpp"

namespace tisserand::mechanism::difference_test {
namespace {

using test_support::error_of;

using ::testing::HasSubstr;

Series sampled(SeriesKind kind, double from, double to, int intervals, double (*f)(double)) {
  Series series;
  series.kind = kind;
  series.source = kind == SeriesKind::run ? "run" : "reference";
  series.channel = "f";
  series.unit = "m";
  series.x_unit = "s";
  for (int i = 0; i <= intervals; ++i) {
    series.x.push_back(from + (to - from) * i / intervals);
    series.y.push_back(f(series.x.back()));
  }
  return series;
}

double wave(double t) { return std::sin(20.0 * t); }
double raised(double t) { return std::sin(20.0 * t) + 0.25; }

// The coarser one has a sixth of a period between its instants, where a cubic through four of them errs by several per
// cent; at its own instants the denser one, 100 instants a period, errs by 1e-7.
TEST(Difference, IsTakenAtTheInstantsOfTheCoarserHistory) {
  const Series coarse = sampled(SeriesKind::run, 0.0, 1.0, 19, raised);
  const Series fine = sampled(SeriesKind::reference, 0.0, 1.0, 311, wave);
  const Series d = difference(coarse, fine, {});
  EXPECT_EQ(d.x.size(), 20u);
  EXPECT_NEAR(d.norms.largest, 0.25, 1e-6);
  EXPECT_NEAR(d.norms.rms, 0.25, 1e-6);
  for (const double y : d.y) EXPECT_NEAR(y, 0.25, 1e-6);
  const Series other = difference(sampled(SeriesKind::run, 0.0, 1.0, 311, raised),
                                  sampled(SeriesKind::reference, 0.0, 1.0, 19, wave), {});
  EXPECT_EQ(other.x.size(), 20u);
  EXPECT_NEAR(other.norms.largest, 0.25, 1e-6);
}

TEST(Difference, CoversTheCommonTime) {
  const Series d = difference(sampled(SeriesKind::run, 0.0, 2.0, 200, raised),
                              sampled(SeriesKind::reference, 1.0, 3.0, 150, wave), {});
  EXPECT_NEAR(d.x.front(), 1.0, 0.02);
  EXPECT_NEAR(d.x.back(), 2.0, 0.02);
}

TEST(Difference, TakesRepeatedInstantsOnceAndLeavesGapsOut) {
  Series run = sampled(SeriesKind::run, 0.0, 1.0, 100, raised);
  run.x.insert(run.x.begin() + 50, run.x[50]);  // the instant of a switch is stored twice
  run.y.insert(run.y.begin() + 50, run.y[50]);
  run.y[20] = std::numeric_limits<double>::quiet_NaN();
  const Series d = difference(run, sampled(SeriesKind::reference, 0.0, 1.0, 200, wave), {});
  EXPECT_EQ(d.x.size(), 100u);
  EXPECT_NEAR(d.norms.largest, 0.25, 1e-5);
}

TEST(Difference, KnowsUnits) {
  Series run = sampled(SeriesKind::run, 0.0, 1.0, 100, raised);
  Series reference = sampled(SeriesKind::reference, 0.0, 1.0, 100, wave);
  for (double& y : reference.y) y *= 1000.0;
  for (double& x : reference.x) x *= 1000.0;
  reference.unit = "mm";
  reference.x_unit = "ms";
  EXPECT_NEAR(difference(run, reference, {}).norms.largest, 0.25, 1e-5);
  reference.unit = "N";
  EXPECT_THAT(error_of([&] { (void)difference(run, reference, {}); }), HasSubstr("the unit N, but the run has m"));
}

TEST(Difference, NeedsOneReferenceForEachChannel) {
  std::vector<Series> series{sampled(SeriesKind::run, 0.0, 1.0, 10, raised)};
  EXPECT_THAT(error_of([&] { append_differences(series); }), HasSubstr("0 references for 'f'"));
  series.push_back(sampled(SeriesKind::reference, 0.0, 1.0, 10, wave));
  series.push_back(sampled(SeriesKind::reference, 0.0, 1.0, 10, raised));
  series.back().channel = "g";
  append_differences(series);  // that of the same name
  ASSERT_EQ(series.size(), 4u);
  EXPECT_EQ(series.back().kind, SeriesKind::difference);
  EXPECT_NEAR(series.back().norms.largest, 0.25, 1e-12);
}

}  // namespace
}  // namespace tisserand::mechanism::difference_test

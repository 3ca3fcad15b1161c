// SPDX-License-Identifier: GPL-3.0-or-later
// Orders, fronts, medians and the cheapest setting of tables that are made up, so that the answers are known.
#include "mechanism/study/findings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "mechanism/study/measure.hpp"

namespace tisserand::mechanism::findings_test {
namespace {

/// Series `one` with errors h² and times 1/h, series `two` with errors h⁴ and ten times the time.
struct MadeUp {
  formats::Study study;
  std::vector<Cell> cells;
  std::vector<StudyRow> rows;

  MadeUp() {
    study.quantities.resize(1);
    for (const char* name : {"one", "two"}) {
      formats::StudySeries series;
      series.name = name;
      series.axes = {{"step", {}, ""}};
      study.series.push_back(series);
    }
    for (int s = 0; s < 2; ++s)
      for (int k = 0; k < 4; ++k) {
        Cell cell;
        cell.series = s;
        cell.values = {fmt::format("{}", 0.1 * std::pow(0.5, k))};
        cell.index = {k};
        cells.push_back(cell);
      }
    for (const Cell& cell : cells) {
      const double h = std::stod(cell.values[0]);
      StudyRow row;
      row.cell = &cell;
      row.has_run = true;
      row.outcome = CellOutcome::completed;
      row.errors = {std::pow(h, cell.series == 0 ? 2 : 4)};
      row.time.median = (cell.series == 0 ? 1.0 : 10.0) / h;
      rows.push_back(row);
    }
  }
};

TEST(Findings, OrdersAreTheExponents) {
  const MadeUp table;
  const std::vector<StudyLine> lines = lines_of(table.study, table.rows);
  ASSERT_EQ(lines.size(), 2u);
  for (int s = 0; s < 2; ++s) {
    const auto orders = observed_orders(table.rows, lines[s], 0);
    EXPECT_FALSE(orders[0]);
    for (int k = 1; k < 4; ++k) EXPECT_NEAR(orders[k].value(), s == 0 ? 2.0 : 4.0, 1e-12);
  }
}

TEST(Findings, FailuresLeaveOrdersOut) {
  MadeUp table;
  table.rows[2].outcome = CellOutcome::failed;
  const auto orders = observed_orders(table.rows, lines_of(table.study, table.rows)[0], 0);
  EXPECT_TRUE(orders[1]);
  EXPECT_FALSE(orders[2]);
  EXPECT_FALSE(orders[3]);
}

// The slider-crank of a trial: 0, 1, 2 and 4 modes give errors of 5.7, 0.61, 0.61 and 0.61 %.
TEST(Findings, ValuesThatChangeNothingAreFound) {
  MadeUp table;
  const auto lines = lines_of(table.study, table.rows);
  EXPECT_FALSE(plateau(table.rows, lines[0], 0));  // errors fall to the last value
  const double errors[] = {0.057, 0.0061, 0.00612, 0.00608};
  for (int k = 0; k < 4; ++k) table.rows[k].errors = {errors[k]};
  EXPECT_EQ(plateau(table.rows, lines[0], 0), 1u);
  table.rows[0].errors = {0.0061};
  EXPECT_EQ(plateau(table.rows, lines[0], 0), 0u);
  table.rows[1].outcome = CellOutcome::failed;  // what was not measured proves nothing
  EXPECT_EQ(plateau(table.rows, lines[0], 0), 2u);
  table.rows[3].outcome = CellOutcome::failed;
  EXPECT_FALSE(plateau(table.rows, lines[0], 0));
}

TEST(Findings, TheCheapestSettingIsFound) {
  MadeUp table;
  const auto lines = lines_of(table.study, table.rows);
  // h = 0.05: 2.5e-3 at a time of 20; the other series needs 100 for its coarsest.
  EXPECT_EQ(cheapest(table.rows, lines, {0}, 3e-3), 1);
  // h⁴ = 6.25e-6 of the other series at 200; of the first even 0.0125 gives 1.6e-4.
  EXPECT_EQ(cheapest(table.rows, lines, {0}, 1e-5), 5);
  EXPECT_EQ(cheapest(table.rows, lines, {0}, 1e-9), -1);
}

TEST(Findings, ADipOfTheErrorIsNoAccuracy) {
  MadeUp table;
  table.rows[0].errors = {1e-9};  // errors cancel at the coarsest step alone
  // The next finer one has 2.5e-3, the one after it 6.25e-4.
  EXPECT_EQ(cheapest(table.rows, lines_of(table.study, table.rows), {0}, 1e-3), 2);
}

TEST(Findings, TheFrontHoldsWhatNothingBeats) {
  MadeUp table;
  // By time: 10 (1e-2), 20 (2.5e-3), 40 (6e-4), 80 (1.6e-4), 100 (1e-4), 200, 400, 800: each is the best so far.
  EXPECT_THAT(pareto_front(table.rows, 0), ::testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  table.rows[2].errors = {1.0};
  EXPECT_THAT(pareto_front(table.rows, 0), ::testing::ElementsAre(0, 1, 3, 4, 5, 6, 7));
}

// Confidence of the interval from the k-th least to the k-th greatest of n: 1 - 2 Σ_{i<k} C(n, i) / 2^n. n = 3: 0.75
// with k = 1; n = 5: 0.9375 with 1, 0.625 with 2; n = 6: 0.78 with 2; n = 9: 0.82 with 3.
TEST(Findings, TheMedianLiesInItsInterval) {
  const auto interval = [](std::vector<double> seconds) {
    const MedianTime time = median_of(std::move(seconds));
    return std::vector{time.least, time.median, time.greatest};
  };
  EXPECT_THAT(interval({7}), ::testing::ElementsAre(7, 7, 7));
  EXPECT_THAT(interval({3, 1, 2}), ::testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(interval({5, 3, 1, 2, 4}), ::testing::ElementsAre(1, 3, 5));
  EXPECT_THAT(interval({6, 5, 3, 1, 2, 4}), ::testing::ElementsAre(2, 3.5, 5));
  EXPECT_THAT(interval({9, 8, 7, 6, 5, 3, 1, 2, 4}), ::testing::ElementsAre(3, 5, 7));
}

Series sine(double amplitude, double delay) {
  Series series;
  series.channel = "y";
  for (int i = 0; i <= 400; ++i) {
    series.x.push_back(0.01 * i);
    series.y.push_back(amplitude * std::sin(0.01 * i - delay));
  }
  return series;
}

// a sin(t - d) against sin t on [0, 4]: |sin| has its peak at pi/2 + d. Parabolas through values 0.01 apart miss a peak
// of curvature 1 by less than 1e-9 in value and 2e-6 in time.
TEST(Measure, NormsOfShiftedAndScaledSines) {
  formats::StudyQuantity quantity;
  const Series reference = sine(1.0, 0.0);
  const auto error = [&](formats::ErrorNorm norm, const Series& series) {
    quantity.norm = norm;
    return error_of(series, reference, quantity);
  };
  EXPECT_NEAR(error(formats::ErrorNorm::max, sine(1.1, 0.0)), 0.1, 1e-5);  // the greatest stored value is 1 - 3e-7
  EXPECT_NEAR(error(formats::ErrorNorm::rms, sine(1.1, 0.0)), 0.1, 1e-12);
  EXPECT_NEAR(error(formats::ErrorNorm::final, sine(1.1, 0.0)), 0.1 * std::abs(std::sin(4.0)), 1e-6);
  EXPECT_NEAR(error(formats::ErrorNorm::peak, sine(1.1, 0.0)), 0.1, 1e-8);
  EXPECT_NEAR(error(formats::ErrorNorm::peak, sine(1.0, 0.3)), 0.0, 1e-8);
  EXPECT_NEAR(error(formats::ErrorNorm::peak_time, sine(1.0, 0.3)), 0.3, 1e-5);
  quantity.scale = 2.0;
  EXPECT_NEAR(error(formats::ErrorNorm::max, sine(1.1, 0.0)), 0.05, 1e-5);
}

}  // namespace
}  // namespace tisserand::mechanism::findings_test

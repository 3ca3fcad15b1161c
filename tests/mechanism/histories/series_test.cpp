// SPDX-License-Identifier: GPL-3.0-or-later
// Histories from CSV files, the choice of channels, and the measure of a run against a reference.
#include "mechanism/histories/series.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "common/error.hpp"
#include "mechanism/histories/tables.hpp"
#include "tests/support/results_rows.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::mechanism::series_test {
namespace {

using test_support::error_of;

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CsvFile : public ::testing::Test {
 protected:
  CsvFile() {
    std::string name = (std::filesystem::temp_directory_path() / "tisserand-csv-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~CsvFile() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& text) const {
    const std::string path = (folder_ / "history.csv").string();
    std::ofstream(path) << text;
    return path;
  }

  std::filesystem::path folder_;
};

TEST(Reference, IsNamedByFileAndColumns) {
  const ReferenceColumn column = parse_reference("a/history.csv:t:wz_base:exact: 32 elements");
  EXPECT_EQ(column.file, "a/history.csv");
  EXPECT_EQ(column.x, "t");
  EXPECT_EQ(column.y, "wz_base");
  EXPECT_EQ(column.label, "exact: 32 elements");
  EXPECT_EQ(parse_reference("a/history.csv:t:w").label, "history");
  EXPECT_EQ(parse_reference("C:/a.csv:t:w").file, "C:/a.csv");
  EXPECT_THAT(error_of([] { (void)parse_reference("history.csv:t"); }), HasSubstr("file.csv:x:y"));
}

TEST(Reference, IsARunWhereTheNameEndsSo) {
  const auto run = parse_reference_run("a:b/fine.results.h5:the fine one");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->file, "a:b/fine.results.h5");
  EXPECT_EQ(run->label, "the fine one");
  EXPECT_EQ(parse_reference_run("fine.results.h5")->label, "fine");
  EXPECT_FALSE(parse_reference_run("fine.h5.csv:t:x"));
}

TEST_F(CsvFile, ColumnsAreFoundWithAndWithoutUnit) {
  const std::string path = write("time [s], \"wz [rad s^-1]\" ,x\r\n0,1e-3,5\r\n\r\n0.5,,6\n1.0,+2.5,nan\n");
  const Series wz = read_reference({path, "time", "wz", "exact"});
  EXPECT_THAT(wz.x, ElementsAre(0.0, 1.0));
  EXPECT_THAT(wz.y, ElementsAre(1e-3, 2.5));
  EXPECT_EQ(wz.unit, "rad s^-1");
  EXPECT_EQ(wz.x_unit, "s");
  EXPECT_EQ(wz.source, "exact");
  EXPECT_EQ(wz.kind, SeriesKind::reference);
  EXPECT_THAT(read_reference({path, "time [s]", "x", ""}).y, ElementsAre(5.0, 6.0));
}

TEST_F(CsvFile, FaultsNameTheirPlace) {
  const auto fault = [this](const std::string& text) {
    return error_of([&] { (void)read_reference({write(text), "t", "w", ""}); });
  };
  EXPECT_THAT(
      fault("t,v\n0,1\n"),
      HasSubstr("there is no column 'w' among the 2 columns; give a number from 1, or a name: the nearest are t, v"));
  EXPECT_THAT(fault("t,w\n0,1\n1,x2\n"), HasSubstr("history.csv:3: 'x2' in column 2 is not a number"));
  EXPECT_THAT(fault("t,w\n0,1,2\n"), HasSubstr("history.csv:2: 3 cells, but the header has 2"));
  EXPECT_THAT(fault(""), HasSubstr("is empty"));
  EXPECT_THAT(error_of([] { (void)read_reference({"none.csv", "t", "w", ""}); }), HasSubstr("none.csv"));
}

TEST_F(CsvFile, ColumnsAreFoundByNumberAndByTheirNearestNames) {
  std::string header = "t", row = "0", next = "1";
  for (int i = 0; i < 300; ++i) {
    header += ",nodes/position/rod/" + std::to_string(i) + "/x";
    row += ",5";
    next += "," + std::to_string(i);
  }
  const std::string path = write(header + ",2\n" + row + ",8\n" + next + ",9\n");
  EXPECT_THAT(read_reference({path, "1", "4", ""}).y, ElementsAre(5.0, 2.0));
  EXPECT_THAT(read_reference({path, "t", "2", ""}).y, ElementsAre(8.0, 9.0));  // a name before a number
  const std::string error = error_of([&] { (void)read_reference({path, "t", "nodes/position/rod/12/y", ""}); });
  EXPECT_THAT(error, HasSubstr("the nearest are nodes/position/rod/12/x, "));
  EXPECT_EQ(std::count(error.begin(), error.end(), ','), 9 + 1);  // ten names
  EXPECT_THAT(error_of([&] {
                (void)read_reference({path, "t", "303", ""});
              }),
              HasSubstr("no column '303' among the 302"));
}

class ResultsFile : public CsvFile {
 protected:
  std::string write_results(const std::string& name) const {
    const std::string path = (folder_ / name).string();
    const formats::ResultsLayout layout = test_support::example_layout();
    formats::ResultsWriter writer(path, layout);
    formats::ResultsRow row;
    row.resize(layout);
    for (int t = 0; t < 20; ++t) {
      test_support::fill_row(t, row);
      row.total = 3.0 + t;
      writer.append(row);
    }
    writer.finish(true, "", "{}");
    return path;
  }
};

TEST_F(ResultsFile, GivesTheChosenChannelsOverTime) {
  const std::string a = write_results("first.results.h5"), b = write_results("second.results.h5");
  const std::vector<Series> series =
      read_series({{a, b}, {"own label"}, {"energy/total", "nodes/position/beam/tip/*"}, {}});
  ASSERT_EQ(series.size(), 8u);
  const auto total =
      std::find_if(series.begin(), series.end(), [](const Series& s) { return s.channel == "energy/total"; });
  ASSERT_NE(total, series.end());
  EXPECT_EQ(total->source, "own label");
  EXPECT_EQ(total->unit, "J");
  EXPECT_EQ(total->x_unit, "s");
  ASSERT_EQ(total->x.size(), 20u);
  EXPECT_EQ(total->x[19], 0.02);  // fill_row(): time is (row + 1) ms
  EXPECT_EQ(total->y[19], 22.0);
  EXPECT_EQ(series.back().source, "second");
}

TEST_F(ResultsFile, FaultsNameWhatIsMissing) {
  const std::string a = write_results("first.results.h5");
  EXPECT_THAT(error_of([&] {
                (void)read_series({{a}, {}, {"energy/totl"}, {}});
              }),
              HasSubstr("did you mean 'energy/total'?"));
  EXPECT_THAT(error_of([&] {
                (void)read_series({{a, a}, {}, {"energy/total", "energy/totl"}, {}});
              }),
              HasSubstr("did you mean 'energy/total'?"))
      << "a channel that no file has";
  EXPECT_THAT(error_of([&] { (void)read_series({{a}, {}, {}, {}}); }), HasSubstr("no channel chosen"));
  EXPECT_THAT(error_of([&] {
                (void)read_series({{a}, {"x", "y"}, {"energy"}, {}});
              }),
              HasSubstr("2 labels for 1 files"));
  EXPECT_THAT(error_of([] { (void)read_series({}); }), HasSubstr("no file to read"));
}

TEST_F(ResultsFile, IsComparedWithItsOwnExport) {
  const std::string a = write_results("first.results.h5"), csv = (folder_ / "first.csv").string();
  export_table(a, {"energy/total"}, csv);
  const std::vector<Series> same = compare({{a}, {}, {"energy/total"}, {{csv, "time", "energy/total", ""}}}, {});
  ASSERT_EQ(same.size(), 1u);
  EXPECT_EQ(same[0].norms.instants, 20u);
  EXPECT_EQ(same[0].norms.largest, 0.0);
  EXPECT_THAT(error_of([&] {
                (void)compare({{a}, {}, {"energy/total"}, {}}, {});
              }),
              HasSubstr("0 references, but exactly one is needed"));
}

TEST_F(ResultsFile, AreComparedChannelByChannel) {
  const std::string a = write_results("first.results.h5"), b = write_results("second.results.h5");
  SeriesRequest request{{a}, {}, {"energy/total", "nodes/position/beam/tip"}, {}};
  request.reference_runs = {{b, "second"}};
  const std::vector<Series> series = read_series(request);
  ASSERT_EQ(series.size(), 8u);
  EXPECT_EQ(series[5].kind, SeriesKind::reference);
  EXPECT_EQ(series[5].channel, series[1].channel);
  EXPECT_EQ(series[5].source, "second");
  const std::vector<Series> same = compare(request, {});
  ASSERT_EQ(same.size(), 4u);
  for (const Series& one : same) EXPECT_EQ(one.norms.largest, 0.0);
}

TEST_F(ResultsFile, ModesAreListedAndReadOverTheirNumbers) {
  const std::string path = (folder_ / "tones.results.h5").string();
  {
    formats::ResultsLayout layout;
    layout.units = Units::si();
    formats::ResultsWriter writer(path, layout);
    formats::ResultsRow row;
    row.resize(layout);
    writer.append(row);
    formats::ModesTable modes;
    modes.eigenvalue = Eigen::Vector3cd::Zero();
    modes.frequency = Eigen::Vector3d(2.0, 3.0, 5.0);
    modes.damping_ratio = Eigen::Vector3d::Zero();
    modes.translation.resize(0, 3);
    modes.rotation.resize(0, 3);
    writer.set_modes(modes);
    writer.finish(true, "", "{}");
  }
  EXPECT_THAT(channels_table(path, {}), AllOf(HasSubstr("1 instant at 0 s, 3 modes\n"), HasSubstr("modes/frequency")));
  const std::vector<Series> series = read_series({{path}, {}, {"modes/frequency"}, {}});
  ASSERT_EQ(series.size(), 1u);
  EXPECT_THAT(series[0].x, ElementsAre(1.0, 2.0, 3.0));
  EXPECT_THAT(series[0].y, ElementsAre(2.0, 3.0, 5.0));
  EXPECT_EQ(series[0].x_name, "mode");
  EXPECT_EQ(series[0].unit, "Hz");
}

TEST_F(ResultsFile, ChannelsAreListedWithUnits) {
  const std::string table = channels_table(write_results("first.results.h5"), {"energy"});
  EXPECT_THAT(table, HasSubstr("scene 'example', 20 instants from 0.001 to 0.02 s\n"));
  EXPECT_THAT(table, HasSubstr("energy/total"));
  EXPECT_THAT(table, HasSubstr("[J]"));
  EXPECT_THAT(table, ::testing::Not(HasSubstr("nodes/")));
}

Series sampled(double from, double to, int intervals, double (*f)(double)) {
  Series series;
  series.source = "run";
  series.channel = "f";
  for (int i = 0; i <= intervals; ++i) {
    series.x.push_back(from + (to - from) * i / intervals);
    series.y.push_back(f(series.x.back()));
  }
  return series;
}

double sine(double t) { return std::sin(t); }
double shifted_sine(double t) { return std::sin(t) + 0.25; }
double cubic(double t) { return t * t * t - 2.0 * t; }

TEST(Deviation, OfAConstantShiftIsTheShift) {
  const double turn = 6.283185307179586;
  const Deviation d = deviation(sampled(0, turn, 1000, shifted_sine), sampled(0, turn, 500, sine), {});
  EXPECT_NEAR(d.largest, 0.25, 1e-12);
  EXPECT_NEAR(d.rms, 0.25, 1e-12);
  // RMS of a sine over whole periods is 1/sqrt(2); the trapezoid rule is exact for it on equal steps.
  EXPECT_NEAR(d.reference_rms, 0.7071067811865476, 1e-12);
  EXPECT_EQ(d.instants, 501u);
}

TEST(Deviation, InterpolatesCubicsExactly) {
  const Deviation d = deviation(sampled(0, 2, 7, cubic), sampled(0, 2, 100, cubic), {});
  EXPECT_LT(d.largest, 1e-14);
}

TEST(Deviation, LooksOnlyAtTheWindowAndTheCommonTime) {
  Series run = sampled(0, 4, 400, sine);
  run.y[100] += 1.0;  // at t = 1
  const Series reference = sampled(-1, 5, 600, sine);
  EXPECT_NEAR(deviation(run, reference, {}).largest, 1.0, 1e-9);
  const Deviation late = deviation(run, reference, {2.0, std::nullopt});
  EXPECT_LT(late.largest, 1e-9);
  EXPECT_NEAR(late.from, 2.0, 0.011);
  EXPECT_NEAR(late.to, 4.0, 0.011);
  EXPECT_THAT(error_of([&] { (void)deviation(run, sampled(7, 8, 10, sine), {}); }),
              HasSubstr("fewer than two instants"));
}

TEST(Deviation, TableHasOneLinePerRun) {
  Series d;
  d.source = "floating_b";
  d.channel = "energy/total";
  d.unit = "J";
  d.norms = {0.5, 0.25, 0.5, 0.0, 1.0, 11};
  const std::string table = deviations_table({d});
  EXPECT_THAT(table, HasSubstr("floating_b  energy/total"));
  EXPECT_THAT(table, HasSubstr("5.000e-01"));
  EXPECT_THAT(table, HasSubstr("50.00 %"));
}

}  // namespace
}  // namespace tisserand::mechanism::series_test

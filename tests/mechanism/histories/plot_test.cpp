// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures: the script that gnuplot reads, its quoting, and one picture from end to end.
#include "mechanism/histories/plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

#include "common/error.hpp"
#include "common/gnuplot.hpp"
#include "mechanism/histories/plot_script.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::mechanism::plot_test {
namespace {

using test_support::error_of;

using ::testing::HasSubstr;
using ::testing::Not;

Series wave(const std::string& source, const std::string& channel, const std::string& unit, std::size_t points) {
  Series series;
  series.source = source;
  series.channel = channel;
  series.unit = unit;
  series.x_unit = "s";
  for (std::size_t i = 0; i < points; ++i) {
    series.x.push_back(0.01 * static_cast<double>(i));
    series.y.push_back(std::sin(series.x.back()));
  }
  return series;
}

Series reference(const std::string& label) {
  Series series = wave(label, "wz_base", "", 10);
  series.kind = SeriesKind::reference;
  return series;
}

PlotOptions into(const std::string& output) {
  PlotOptions options;
  options.output = output;
  return options;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

TEST(GnuplotQuoted, ExpandsNothing) {
  EXPECT_EQ(gnuplot_quoted("a `rm` $x \"b\" \\n"), "'a `rm` $x \"b\" \\n'");
  EXPECT_EQ(gnuplot_quoted("it's"), R"('it'."'".'s')");
  EXPECT_EQ(gnuplot_quoted("'90s"), R"(''."'".'90s')");
  EXPECT_EQ(gnuplot_quoted("a\nsystem('x')\x01"), R"('a system('."'".'x'."'".')\x01')");
}

TEST(GnuplotScript, KeepsForeignTextInsideQuotes) {
  PlotOptions options;
  options.output = "|touch owned;.svg";
  options.title = "'; system('touch owned'); '";
  const std::string script = gnuplot_script({wave("run", "energy/total", "J", 5)}, options);
  EXPECT_THAT(script, HasSubstr(R"(set title ''."'".'; system('."'".'touch owned'."'".'); '."'".'')"));
  EXPECT_THAT(script, Not(HasSubstr("set output")));
}

TEST(GnuplotScript, LabelsAxesWithQuantityAndUnit) {
  const std::string script =
      gnuplot_script({wave("run", "nodes/angular_velocity/beam/tip/z", "rad s^-1", 5)}, into("a.png"));
  EXPECT_THAT(script, HasSubstr("set ylabel 'angular velocity [rad s⁻¹]'"));
  EXPECT_THAT(script, HasSubstr("set xlabel 'time [s]'"));
  EXPECT_THAT(script, HasSubstr("title 'beam/tip/z'"));
  EXPECT_THAT(gnuplot_script({wave("run", "solver/iterations", "1", 5)}, into("a.png")),
              HasSubstr("set ylabel 'iterations'"));
  PlotOptions own = into("a.png");
  own.x_label = "turns";
  own.y_label = "speed";
  EXPECT_THAT(gnuplot_script({wave("run", "energy/total", "J", 5)}, own), HasSubstr("set ylabel 'speed'"));
}

TEST(GnuplotScript, LegendNamesWhatDiffers) {
  const auto legend = [](const std::vector<Series>& series) { return gnuplot_script(series, into("a.png")); };
  EXPECT_THAT(legend({wave("a", "energy/total", "J", 5), wave("b", "energy/total", "J", 5)}), HasSubstr("title 'b'"));
  EXPECT_THAT(legend({wave("a", "energy/total", "J", 5), wave("a", "energy/kinetic", "J", 5)}),
              HasSubstr("title 'kinetic'"));
  EXPECT_THAT(legend({wave("a", "energy/total", "J", 5), wave("b", "energy/kinetic", "J", 5)}),
              HasSubstr("title 'b: kinetic'"));
}

TEST(GnuplotScript, LegendIsTheLabelWhereItSaysAll) {
  std::vector<Series> series = {wave("a", "nodes/position/rod/base/x", "m", 5),
                                wave("b", "nodes/position/rod/start/x", "m", 5)};
  for (Series& one : series) one.has_own_label = true;
  EXPECT_THAT(gnuplot_script(series, into("a.png")), HasSubstr("title 'b'"));
}

TEST(GnuplotScript, ReferencesLieBeneathAndJoinTheFirstPanel) {
  const std::string script = gnuplot_script(
      {wave("a", "energy/total", "J", 5), wave("a", "solver/step", "s", 5), reference("exact")}, into("a.png"));
  EXPECT_EQ(count(script, "\nplot "), 2u);
  EXPECT_LT(script.find("title 'exact'"), script.find("title 'total'"));
  EXPECT_LT(script.find("title 'total'"), script.find("title 'step'"));
  EXPECT_THAT(script, HasSubstr("set multiplot layout 2,1"));
}

TEST(GnuplotScript, RefusesMoreThanFourUnits) {
  std::vector<Series> series;
  for (const char* unit : {"m", "s", "J", "N", "rad"}) series.push_back(wave("a", "energy/total", unit, 5));
  EXPECT_THAT(error_of([&] { (void)gnuplot_script(series, into("a.png")); }), HasSubstr("5 different units"));
}

TEST(GnuplotScript, RangesAndLogarithmicScales) {
  PlotOptions options = into("a.svg");
  options.x_range = {0.5, 2.0};
  options.y_scale = AxisScale::logarithmic;
  const std::string script = gnuplot_script({wave("a", "energy/total", "J", 5)}, options);
  EXPECT_THAT(script, HasSubstr("set xrange [0.5:2]"));
  EXPECT_THAT(script, HasSubstr("set logscale y"));
  EXPECT_THAT(script, Not(HasSubstr("set logscale x")));
}

TEST(GnuplotScript, DrawsModesAsBarsBesideOneAnother) {
  std::vector<Series> series = {wave("a", "modes/frequency", "Hz", 5), wave("b", "modes/frequency", "Hz", 5)};
  for (Series& one : series) {
    one.x = {1, 2, 3, 4, 5};
    one.x_name = "mode";
    one.x_unit = "";
  }
  const std::string script = gnuplot_script(series, into("a.svg"));
  EXPECT_THAT(script, HasSubstr("$d0 using ($1-0.2):2:(0.38) with boxes"));
  EXPECT_THAT(script, HasSubstr("$d1 using ($1+0.2):2:(0.38) with boxes"));
  EXPECT_THAT(script, HasSubstr("set xrange [0.5:5.5]"));
  EXPECT_THAT(script, HasSubstr("set xlabel 'mode'"));
  // Bars stand on zero. Round-off can make the damping of undamped modes negative: that does not lower the axis.
  const auto axis_of = [&](const std::vector<double>& values, const char* unit) {
    Series damping = series.front();
    damping.unit = unit;
    damping.y = values;
    const std::string text = gnuplot_script({damping}, into("a.svg"));
    const std::size_t at = text.find("set yrange ");
    return text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_EQ(axis_of({0.1, 0.02, 0.3, 1, 0}, "1"), "set yrange [0:*]");
  EXPECT_EQ(axis_of({0.1, -1e-14, 0.3, 1, 0}, "1"), "set yrange [0:*]");
  EXPECT_EQ(axis_of({0.1, -0.02, 0.3, 1, 0}, "1"), "set yrange [*<0:0<*]");
  EXPECT_EQ(axis_of({1e-17, -1e-17, 0, 0, 0}, "1"), "set yrange [0:1]");
  EXPECT_EQ(axis_of({0, 0, 0, 0, 0}, "Hz"), "set yrange [0:1]");
  series.push_back(wave("a", "energy/total", "J", 5));
  EXPECT_THAT(error_of([&] { plot(series, {}); }),
              HasSubstr("'modes/frequency' has values over modes, 'energy/total' over time"));
}

TEST(GnuplotScript, ShowsTheTimeOfTheRuns) {
  const Series run = wave("a", "energy/total", "J", 5);  // 0 to 0.04; the reference goes on to 0.09
  EXPECT_THAT(gnuplot_script({run, reference("exact")}, into("a.svg")), HasSubstr("set xrange [0:0.04]"));
  EXPECT_THAT(gnuplot_script({reference("exact")}, into("a.svg")), Not(HasSubstr("set xrange")));
}

TEST(GnuplotScript, ThinsLongHistoriesToTheirEnvelope) {
  Series series = wave("a", "energy/total", "J", 1000000);
  series.y[123457] = 77.0;  // one spike among a million points must stay
  series.y[765432] = -78.0;
  const std::string script = gnuplot_script({series}, into("a.png"));
  EXPECT_LT(count(script, "\n"), 13000u);
  EXPECT_THAT(script, HasSubstr(" 77\n"));
  EXPECT_THAT(script, HasSubstr(" -78\n"));
  EXPECT_THAT(script, HasSubstr("9999.99 "));
}

TEST(GnuplotScript, LeavesGapsWhereThereIsNoNumber) {
  Series series = wave("a", "joints/coordinate/hinge", "rad", 3);
  series.y[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(gnuplot_script({series}, into("a.png")), Not(HasSubstr("nan")));
}

// Long dashes hide an oscillation that is as long as they are: every line is solid, marks tell them apart.
TEST(GnuplotScript, LinesAreSolidWithMarksAtPlacesOfTheirOwn) {
  const Series a = wave("a", "energy/total", "J", 1000);
  const std::string script = gnuplot_script({a, wave("b", "energy/total", "J", 1000)}, into("a.png"));
  EXPECT_THAT(script, Not(HasSubstr(" dt ")));
  EXPECT_EQ(count(script, "keyentry with linespoints"), 2u);
  const auto block = [&](const std::string& name) {
    const std::size_t begin = script.find("$" + name + " << EOD\n");
    return script.substr(begin, script.find("EOD\n", begin + name.size() + 9) - begin);
  };
  EXPECT_EQ(count(block("m0"), "\n"), 1u + 9u);
  EXPECT_EQ(count(block("m1"), "\n"), 1u + 9u);
  EXPECT_NE(block("m0").substr(12, 12), block("m1").substr(12, 12));
  EXPECT_THAT(gnuplot_script({a}, into("a.png")), Not(HasSubstr("with points")));  // nothing to tell it apart from
}

TEST(GnuplotScript, HasNoLegendOfHundredsOfNames) {
  std::vector<Series> series;
  for (int i = 0; i < 25; ++i) series.push_back(wave("a", "nodes/position/" + std::to_string(i) + "/x", "m", 5));
  const std::string script = gnuplot_script(series, into("a.png"));
  EXPECT_THAT(script, HasSubstr("unset key"));
  EXPECT_THAT(script, HasSubstr("set ylabel '25 x position [m]'"));
  series.pop_back();
  EXPECT_THAT(gnuplot_script(series, into("a.png")), HasSubstr("set key above"));
}

TEST(GnuplotScript, LogarithmicAxesFitWhatTheyShow) {
  Series series = wave("a", "error", "1", 3);
  series.x = {0.11, 0.13, 0.3};
  series.y = {0.1, 0.05, 0.02};
  PlotOptions options = into("a.svg");
  options.x_scale = options.y_scale = AxisScale::logarithmic;
  const std::string script = gnuplot_script({series}, options);
  EXPECT_THAT(script, HasSubstr("set ytics ('0.02' 0.02, '0.05' 0.05, '0.1' 0.1)"));
  EXPECT_THAT(script, HasSubstr("set xtics ('0.1' 0.1, '0.2' 0.2)"));
  EXPECT_THAT(script, HasSubstr("set xrange [0.09"));
}

TEST(GnuplotScript, DifferencesHaveAPanelOfTheirOwn) {
  Series base = wave("fine", "energy/total", "J", 5);
  base.kind = SeriesKind::reference;
  base.is_of_run = true;
  Series difference = wave("coarse", "energy/total", "J", 5);
  difference.kind = SeriesKind::difference;
  difference.norms = {0.25, 0.125, 1.0};
  const std::string script = gnuplot_script({wave("coarse", "energy/total", "J", 5), base, difference}, into("a.pdf"));
  EXPECT_THAT(script, HasSubstr("set multiplot layout 2,1"));
  EXPECT_THAT(script, HasSubstr("set ylabel 'difference of energy [J]'"));
  EXPECT_THAT(script, HasSubstr("title 'total: largest 0.25, RMS 0.125'"));
  EXPECT_THAT(script, HasSubstr("set terminal pdfcairo size 6.29921in,"));  // 160 mm
}

TEST(PictureSize, IsOfPixelsOrPaper) {
  const PictureSize pixels = parse_picture_size("1400x800"), paper = parse_picture_size("16x10.5cm");
  EXPECT_EQ(pixels.width, 1400.0);
  EXPECT_FALSE(pixels.on_paper);
  EXPECT_EQ(paper.width, 160.0);
  EXPECT_EQ(paper.height, 105.0);
  EXPECT_TRUE(paper.on_paper);
  EXPECT_NEAR(parse_picture_size("4x3in").width, 101.6, 1e-9);
  for (const char* bad : {"", "x", "160", "160xmm", "160x100m", "nanx100", "1x1", "1e9x5"})
    EXPECT_THAT(error_of([&] { (void)parse_picture_size(bad); }), HasSubstr("--size")) << bad;
}

TEST(PictureFont, HasANameASizeOrBoth) {
  EXPECT_EQ(parse_picture_font("9").size, 9.0);
  EXPECT_EQ(parse_picture_font("DejaVu Sans").name, "DejaVu Sans");
  EXPECT_FALSE(parse_picture_font("DejaVu Sans").size);
  EXPECT_EQ(parse_picture_font("DejaVu Sans,9.5").size, 9.5);
  for (const char* bad : {"", "Sans,", "Sans,big", "Sans,1e5", "a,b,9"})
    EXPECT_THAT(error_of([&] { (void)parse_picture_font(bad); }), HasSubstr("--font")) << bad;
}

TEST(Superscripts, OfUnits) {
  EXPECT_EQ(with_superscripts("kg m s^-2"), "kg m s⁻²");
  EXPECT_EQ(with_superscripts("m^12/s"), "m¹²/s");
  EXPECT_EQ(with_superscripts("rad"), "rad");
}

class Picture : public ::testing::Test {
 protected:
  Picture() {
    std::string name = (std::filesystem::temp_directory_path() / "tisserand-plot-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~Picture() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }

  std::filesystem::path folder_;
};

TEST_F(Picture, IsWrittenAsPngAndSvg) {
  PlotOptions options;
  options.title = "it's a `title`";
  options.output = path("a b.png");
  plot({wave("a", "energy/total", "J", 50), reference("exact")}, options);
  std::ifstream png(options.output, std::ios::binary);
  std::string head(4, ' ');
  png.read(head.data(), 4);
  EXPECT_EQ(head, "\x89PNG");

  options.output = path("a.svg");
  plot({wave("a", "energy/total", "J", 50), reference("exact")}, options);
  std::ifstream svg(options.output);
  const std::string text((std::istreambuf_iterator<char>(svg)), {});
  EXPECT_THAT(text, HasSubstr("it's a `title`"));
  EXPECT_THAT(text, HasSubstr("</svg>"));
  EXPECT_EQ(files(), 2u);
}

TEST_F(Picture, IsWrittenForPrint) {
  PlotOptions options;
  options.size = parse_picture_size("80x60mm");
  options.font = parse_picture_font("DejaVu Sans,8");
  for (const auto& [ending, begin] : {std::pair{".pdf", "%PDF"}, {".eps", "%!PS"}}) {
    options.output = path(std::string("a") + ending);
    (void)plot({wave("a", "energy/total", "J", 50), wave("b", "energy/total", "J", 50)}, options);
    std::ifstream file(options.output, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(text.substr(0, 4), begin);
    if (std::string(ending) == ".eps") {
      EXPECT_THAT(text, HasSubstr("%%BoundingBox: 0 0 22"));  // 80 mm are 226.8 pt
    }
  }
  options.output = path("a.png");
  (void)plot({wave("a", "energy/total", "J", 50)}, options);
  std::ifstream png(options.output, std::ios::binary);
  const std::string head((std::istreambuf_iterator<char>(png)), {});
  EXPECT_EQ(head.substr(16, 8), std::string("\0\0\x03\xb1\0\0\x02\xc5", 8));  // 80 x 60 mm at 300 per inch: 945 x 709
}

TEST_F(Picture, FaultsAreReportedAndLeaveNothing) {
  const Series series = wave("a", "energy/total", "J", 5);
  PlotOptions options;
  options.output = path("a.bmp");
  EXPECT_THAT(error_of([&] { plot({series}, options); }), HasSubstr("is not a .png, .svg, .pdf or .eps"));
  options.output = path("none/a.png");
  EXPECT_THAT(error_of([&] { plot({series}, options); }), HasSubstr("cannot create the file"));
  options.output = path("a.png");
  EXPECT_THAT(error_of([&] { plot({wave("a", "energy/total", "J", 0)}, options); }), HasSubstr("nothing to draw"));
  Series empty = wave("a", "nodes/rotation/beam/tip/w", "", 5);
  empty.y.assign(empty.y.size(), std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(error_of([&] {
              plot({series, empty}, options);
            }),
            "a: channel 'nodes/rotation/beam/tip/w' holds no finite value; choose another channel");
  Series negative = series;
  negative.y.assign(negative.y.size(), -1.0);
  options.y_scale = AxisScale::logarithmic;
  EXPECT_THAT(error_of([&] { plot({negative}, options); }),
              HasSubstr("'energy/total' has no positive values, which a logarithmic axis needs"));
  options.y_scale = AxisScale::linear;
  options.x_range = {1.0, 1.0};
  options.y_range = {5.0, 5.0};
  EXPECT_THAT(error_of([&] { plot({series}, options); }), HasSubstr("range"));
  EXPECT_EQ(files(), 0u);
}

TEST_F(Picture, WithoutGnuplotNamesThePackage) {
  const std::string before = std::getenv("PATH");
  ::setenv("PATH", folder_.c_str(), 1);
  PlotOptions options;
  options.output = path("a.png");
  const std::string text = error_of([&] { plot({wave("a", "energy/total", "J", 5)}, options); });
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_THAT(text, HasSubstr("gnuplot-nox"));
}

}  // namespace
}  // namespace tisserand::mechanism::plot_test

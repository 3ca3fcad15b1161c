// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the series to draw, and a run of gnuplot on the script.
#include "mechanism/histories/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.hpp"
#include "common/gnuplot.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"
#include "formats/page/picture_mark.hpp"
#include "mechanism/histories/plot_script.hpp"

namespace tisserand::mechanism {
namespace {

/// Throws Error if series over time and over modes are mixed.
void check_abscissae(const std::vector<Series>& series) {
  for (const Series& one : series)
    if (one.kind == SeriesKind::run && is_of_modes(one) != is_of_modes(series.front()))
      throw Error(fmt::format("'{}' has values over modes, '{}' over time",
                              is_of_modes(one) ? one.channel : series.front().channel,
                              is_of_modes(one) ? series.front().channel : one.channel),
                  "plot", "draw them in two pictures");
}

/// Throws Error if a series has no finite value, as for a node without rotations; gnuplot cannot draw axes then.
void check_finite(const std::vector<Series>& series) {
  const auto has_value = [&series](std::size_t index) {
    const Series& one = series[index];
    for (std::size_t i = 0; i < one.x.size(); ++i)
      if (std::isfinite(one.x[i]) && std::isfinite(one.y[i])) return true;
    return false;
  };
  for (const Panel& panel : panels_of(series)) {
    if (std::any_of(panel.members.begin(), panel.members.end(), has_value)) continue;
    const Series& first = series[panel.members.front()];
    throw Error(fmt::format("channel '{}' holds no finite value", first.channel), first.source,
                "choose another channel");
  }
}

/// Throws Error for an empty picture, because gnuplot's own message names lines of the script.
void check_something_is_seen(const std::vector<Series>& series, const PlotOptions& options) {
  const auto range = options.x_range;
  bool is_in_range = false, is_positive = false;
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Series& one : series)
    for (std::size_t i = 0; i < one.x.size(); ++i) {
      if (!std::isfinite(one.x[i]) || !std::isfinite(one.y[i])) continue;
      first = std::min(first, one.x[i]);
      last = std::max(last, one.x[i]);
      if (range && !(one.x[i] >= std::min((*range)[0], (*range)[1]) && one.x[i] <= std::max((*range)[0], (*range)[1])))
        continue;
      is_in_range = true;
      is_positive = is_positive || ((options.x_scale == AxisScale::linear || one.x[i] > 0.0) &&
                                    (options.y_scale == AxisScale::linear || one.y[i] > 0.0));
    }
  const Series& one = series.front();
  if (!is_in_range)
    throw Error(fmt::format("no values between {:g} and {:g}; the run goes from {:g} to {:g} {}", (*range)[0],
                            (*range)[1], first, last, one.x_unit),
                one.source, "choose another --range");
  if (!is_positive)
    throw Error(fmt::format("'{}' has no positive values, which a logarithmic axis needs", one.channel), one.source,
                "omit --log-x and --log-y, or choose another channel");
}

/// Text on norms of differences and omitted legends.
std::string reported(const std::vector<Series>& series, const PlotOptions& options) {
  std::string text;
  for (const Series& one : series)
    if (one.kind == SeriesKind::difference)
      text += fmt::format("{}, {}: differs by at most {:.6g}{}, RMS {:.6g}{}\n", printable_line(one.source, 200),
                          one.channel, one.norms.largest, one.unit.empty() ? "" : " " + one.unit, one.norms.rms,
                          one.norms.reference_rms > 0.0 ? fmt::format(" ({:.3g} % of the RMS of the reference)",
                                                                      100.0 * one.norms.rms / one.norms.reference_rms)
                                                        : "");
  return text + missing_legends(series, options);
}

}  // namespace

std::string plot(const std::vector<Series>& series, const PlotOptions& options) {
  const bool has_points = std::any_of(series.begin(), series.end(), [](const Series& s) { return !s.x.empty(); });
  if (!has_points) throw Error("nothing to draw: the chosen channels hold no instant", "plot", "choose another run");
  check_abscissae(series);
  check_finite(series);
  check_something_is_seen(series, options);
  (void)canvas_of(options.output, options.size, options.font, 1,
                  0);  // throws Error for another ending before anything else happens
  write_text_file(
      options.output,
      formats::with_producer(gnuplot_picture(gnuplot_script(series, options), options.output), producer("mechanism")));
  return reported(series, options);
}

}  // namespace tisserand::mechanism

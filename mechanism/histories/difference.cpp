// SPDX-License-Identifier: GPL-3.0-or-later
// Differences at the instants of the coarser history.
#include "mechanism/histories/difference.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "mechanism/histories/shown_units.hpp"

namespace tisserand::mechanism {
namespace {

/// Series with ascending instants and finite values; of equal instants, as at a switch, the last counts.
Series usable(const Series& series) {
  Series result = series;
  result.x.clear();
  result.y.clear();
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
    if (!result.x.empty() && series.x[i] < result.x.back())
      throw Error(fmt::format("'{}' of '{}' does not increase: {:g} follows {:g}", series.x_name, series.source,
                              series.x[i], result.x.back()),
                  "--difference", "give histories over time");
    if (!result.x.empty() && series.x[i] == result.x.back()) {
      result.y.back() = series.y[i];
      continue;
    }
    result.x.push_back(series.x[i]);
    result.y.push_back(series.y[i]);
  }
  return result;
}

/// Converts the values to the units of another series, if both have units. Throws Error if their dimensions differ.
void convert(const std::string& from, const std::string& to, const std::string& where, std::vector<double>& values) {
  if (from.empty() || to.empty() || from == to) return;
  const auto own = measured_unit(from), wanted = measured_unit(to);
  if (!own || !wanted || own->dimension != wanted->dimension)
    throw Error(fmt::format("the reference has the unit {}, but the run has {}", from, to), where,
                "compare the same quantity");
  for (double& value : values) value *= own->factor / wanted->factor;
}

double mean_square(const std::vector<double>& x, const std::vector<double>& y) {
  double integral = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i) integral += 0.5 * (x[i] - x[i - 1]) * (y[i] * y[i] + y[i - 1] * y[i - 1]);
  return integral / (x.back() - x.front());
}

std::size_t instants_between(const Series& series, double from, double to) {
  return static_cast<std::size_t>(std::ranges::count_if(series.x, [&](double x) { return x >= from && x <= to; }));
}

}  // namespace

double value_at(const Series& series, double x) {
  const auto above = std::lower_bound(series.x.begin(), series.x.end(), x);
  const auto right = static_cast<std::size_t>(above - series.x.begin());
  if (right < series.x.size() && series.x[right] == x) return series.y[right];
  const std::size_t n = series.x.size();
  const std::size_t first = std::min(right < 2 ? 0 : right - 2, n < 4 ? 0 : n - 4);
  const std::size_t last = std::min(n, first + 4);
  double value = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    double weight = 1.0;
    for (std::size_t j = first; j < last; ++j)
      if (j != i) weight *= (x - series.x[j]) / (series.x[i] - series.x[j]);
    value += weight * series.y[i];
  }
  return value;
}

Series difference_at_reference(const Series& series, const Series& reference, const TimeWindow& window) {
  Series result = series;
  result.kind = SeriesKind::difference;
  result.x.clear();
  result.y.clear();
  std::vector<double> expected;
  for (std::size_t i = 0; i < reference.x.size() && !series.x.empty(); ++i) {
    const double t = reference.x[i];
    const bool is_outside_run = t < series.x.front() || t > series.x.back();
    const bool is_outside_window = (window.from && t < *window.from) || (window.to && t > *window.to);
    if (is_outside_run || is_outside_window) continue;
    result.x.push_back(t);
    result.y.push_back(value_at(series, t) - reference.y[i]);
    expected.push_back(reference.y[i]);
  }
  if (result.x.size() < 2 || !(result.x.back() > result.x.front()))
    throw Error("fewer than two instants in common with the reference '" + reference.source + "'",
                series.source + ", " + series.channel,
                "compare histories that overlap in time, or widen --from and --to");
  result.norms = {0.0,
                  std::sqrt(mean_square(result.x, result.y)),
                  std::sqrt(mean_square(result.x, expected)),
                  result.x.front(),
                  result.x.back(),
                  result.x.size()};
  for (const double d : result.y) result.norms.largest = std::max(result.norms.largest, std::abs(d));
  return result;
}

Deviation deviation(const Series& series, const Series& reference, const TimeWindow& window) {
  return difference_at_reference(series, reference, window).norms;
}

Series difference(const Series& series, const Series& reference, const TimeWindow& window) {
  const Series run = usable(series);
  Series expected = usable(reference);
  convert(expected.unit, run.unit, series.channel, expected.y);
  convert(expected.x_unit, run.x_unit, series.channel, expected.x);
  if (run.x.empty() || expected.x.empty()) return difference_at_reference(run, expected, window);
  const double from = std::max(run.x.front(), expected.x.front()), to = std::min(run.x.back(), expected.x.back());
  if (instants_between(run, from, to) >= instants_between(expected, from, to))
    return difference_at_reference(run, expected, window);
  Series coarse = expected;
  coarse.x.clear();
  coarse.y.clear();
  for (const double x : run.x) {
    if (x < from || x > to) continue;
    coarse.x.push_back(x);
    coarse.y.push_back(value_at(expected, x));
  }
  return difference_at_reference(run, coarse, window);
}

const Series& reference_of(const Series& run, const std::vector<Series>& all) {
  std::vector<const Series*> named, others;
  for (const Series& one : all)
    if (one.kind == SeriesKind::reference) (one.channel == run.channel ? named : others).push_back(&one);
  const std::vector<const Series*>& fitting = named.empty() ? others : named;
  if (fitting.size() != 1)
    throw Error(fmt::format("{} references for '{}', but exactly one is needed", fitting.size(), run.channel),
                "--difference", "name one with --reference: other.results.h5, or file.csv:t:column");
  return *fitting.front();
}

void append_differences(std::vector<Series>& series) {
  std::vector<Series> differences;
  for (const Series& one : series)
    if (one.kind == SeriesKind::run) differences.push_back(difference(one, reference_of(one, series), {}));
  if (differences.empty()) throw Error("there is no run to compare", "--difference", "name a results file");
  series.insert(series.end(), std::make_move_iterator(differences.begin()), std::make_move_iterator(differences.end()));
}

}  // namespace tisserand::mechanism

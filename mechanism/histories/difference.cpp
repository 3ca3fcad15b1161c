// Differences at the instants of the coarser history.
#include "mechanism/histories/difference.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "mechanism/histories/shown_units.hpp"

namespace tisserand::mechanism {
namespace {

/// Ascending instants, each once (the last of those that are equal: after a switch), with finite values.
Series usable(const Series& series) {
  Series result = series;
  result.x.clear();
  result.y.clear();
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
    if (!result.x.empty() && series.x[i] < result.x.back())
      throw Error(fmt::format("'{}' of '{}' does not ascend: {:g} follows {:g}", series.x_name, series.source,
                              series.x[i], result.x.back()),
                  "--difference", "differences need histories over time");
    if (!result.x.empty() && series.x[i] == result.x.back()) {
      result.y.back() = series.y[i];
      continue;
    }
    result.x.push_back(series.x[i]);
    result.y.push_back(series.y[i]);
  }
  return result;
}

/// The values in the units of another series, where both have names. Throws Error for units of other quantities.
void convert(const std::string& from, const std::string& to, const std::string& where, std::vector<double>& values) {
  if (from.empty() || to.empty() || from == to) return;
  const auto own = measured_unit(from), wanted = measured_unit(to);
  if (!own || !wanted || own->dimension != wanted->dimension)
    throw Error(fmt::format("the reference has the unit {}, the run {}", from, to), where, "compare equal quantities");
  for (double& value : values) value *= own->factor / wanted->factor;
}

std::size_t instants_between(const Series& series, double from, double to) {
  return static_cast<std::size_t>(std::ranges::count_if(series.x, [&](double x) { return x >= from && x <= to; }));
}

}  // namespace

Difference difference(const Series& series, const Series& reference, const TimeWindow& window) {
  const Series run = usable(series);
  Series other = usable(reference);
  convert(other.unit, run.unit, series.channel, other.y);
  convert(other.x_unit, run.x_unit, series.channel, other.x);
  Series expected = other;
  if (!run.x.empty() && !other.x.empty()) {
    const double from = std::max(run.x.front(), other.x.front()), to = std::min(run.x.back(), other.x.back());
    if (instants_between(run, from, to) < instants_between(other, from, to)) {
      expected.x.clear();
      expected.y.clear();
      for (const double x : run.x) {
        if (x < from || x > to) continue;
        expected.x.push_back(x);
        expected.y.push_back(value_at(other, x));
      }
    }
  }
  Difference result{series, deviation(run, expected, window)};
  result.curve.kind = SeriesKind::difference;
  result.curve.x.clear();
  result.curve.y.clear();
  for (std::size_t i = 0; i < expected.x.size(); ++i) {
    if (expected.x[i] < run.x.front() || expected.x[i] > run.x.back()) continue;
    result.curve.x.push_back(expected.x[i]);
    result.curve.y.push_back(value_at(run, expected.x[i]) - expected.y[i]);
  }
  result.curve.norms = {result.norms.largest, result.norms.rms, result.norms.reference_rms};
  return result;
}

void append_differences(std::vector<Series>& series) {
  std::vector<Series> differences;
  for (const Series& one : series) {
    if (one.kind != SeriesKind::run) continue;
    std::vector<const Series*> named, all;
    for (const Series& other : series) {
      if (other.kind != SeriesKind::reference) continue;
      all.push_back(&other);
      if (other.channel == one.channel) named.push_back(&other);
    }
    const std::vector<const Series*>& fitting = named.empty() ? all : named;
    if (fitting.size() != 1)
      throw Error(fmt::format("{} references for '{}', one is needed", fitting.size(), one.channel), "--difference",
                  "name one with --reference: other.results.h5, or file.csv:t:column");
    differences.push_back(difference(one, *fitting.front(), {}).curve);
  }
  if (differences.empty()) throw Error("there is no run to compare", "--difference", "name a results file");
  series.insert(series.end(), std::make_move_iterator(differences.begin()), std::make_move_iterator(differences.end()));
}

}  // namespace tisserand::mechanism

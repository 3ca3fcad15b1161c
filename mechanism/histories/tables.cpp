// Lists channels, exports them, and measures runs against reference histories.
#include "mechanism/histories/tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/histories/difference.hpp"

namespace tisserand::mechanism {
namespace {

double mean_square(const std::vector<double>& x, const std::vector<double>& y) {
  double integral = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i) integral += 0.5 * (x[i] - x[i - 1]) * (y[i] * y[i] + y[i - 1] * y[i - 1]);
  return integral / (x.back() - x.front());
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

std::string channels_table(const std::string& file, const std::vector<std::string>& patterns) {
  const formats::ResultsReader reader(file);
  const std::vector<double> time = reader.time();
  std::string text = fmt::format("{}: scene '{}', {} instants", file, reader.scene(), time.size());
  if (!time.empty()) text += fmt::format(" from {:g} to {:g}", time.front(), time.back());
  if (reader.modes() > 0) text += fmt::format(", {} modes", reader.modes());
  if (!reader.completed()) text += fmt::format("\nnot completed: {}", reader.reason());
  text += "\n";
  const std::vector<formats::Channel> chosen = formats::select_channels(reader.channels(), patterns, file);
  std::size_t width = 0;
  for (const formats::Channel& channel : chosen) width = std::max(width, channel.name.size());
  for (const formats::Channel& channel : chosen) {
    std::string line = channel.name;
    if (!channel.unit.empty()) line = fmt::format("{:<{}}  [{}]", channel.name, width, channel.unit);
    if (!channel.same_as.empty()) line += "  = " + channel.same_as;
    text += line + "\n";
  }
  return text;
}

void export_table(const std::string& file, const std::vector<std::string>& patterns, const std::string& output) {
  formats::export_csv(formats::ResultsReader(file), patterns, output);
}

Deviation deviation(const Series& series, const Series& reference, const TimeWindow& window) {
  const std::string where = series.source + ", " + series.channel;
  std::vector<double> time, difference, expected;
  if (!series.x.empty())
    for (std::size_t i = 0; i < reference.x.size(); ++i) {
      const double t = reference.x[i];
      const bool is_outside_run = t < series.x.front() || t > series.x.back();
      const bool is_outside_window = (window.from && t < *window.from) || (window.to && t > *window.to);
      if (is_outside_run || is_outside_window) continue;
      time.push_back(t);
      expected.push_back(reference.y[i]);
      difference.push_back(value_at(series, t) - reference.y[i]);
    }
  if (time.size() < 2 || !(time.back() > time.front()))
    throw Error("fewer than two instants in common with the reference '" + reference.source + "'", where,
                "compare histories that overlap in time, or widen --from and --to");
  Deviation result;
  result.label = series.source;
  result.channel = series.channel;
  result.unit = series.unit;
  result.from = time.front();
  result.to = time.back();
  result.instants = time.size();
  for (const double d : difference) result.largest = std::max(result.largest, std::abs(d));
  result.rms = std::sqrt(mean_square(time, difference));
  result.reference_rms = std::sqrt(mean_square(time, expected));
  return result;
}

std::vector<Deviation> compare(const SeriesRequest& request, const TimeWindow& window) {
  const std::size_t references = request.references.size() + request.reference_runs.size();
  if (references != 1)
    throw Error(fmt::format("{} references, one is needed", references), "compare",
                "name it with --reference file.csv:t:column, or --reference other.results.h5");
  const std::vector<Series> all = read_series(request);
  std::vector<Deviation> deviations;
  std::map<std::string, const Series*> of_channel;
  for (const Series& series : all)
    if (series.is_of_run) of_channel.emplace(series.channel, &series);
  for (const Series& series : all) {
    if (series.kind != SeriesKind::run) continue;
    if (!of_channel.empty())
      deviations.push_back(difference(series, *of_channel.at(series.channel), window).norms);
    else
      deviations.push_back(deviation(series, all.back(), window));
  }
  return deviations;
}

std::string deviations_table(const std::vector<Deviation>& deviations) {
  std::vector<std::array<std::string, 6>> rows = {{"run", "channel", "max error", "RMS error", "relative RMS", "unit"}};
  for (const Deviation& d : deviations)
    rows.push_back({d.label, d.channel, fmt::format("{:.3e}", d.largest), fmt::format("{:.3e}", d.rms),
                    d.reference_rms > 0.0 ? fmt::format("{:.2f} %", 100.0 * d.rms / d.reference_rms) : "-", d.unit});
  std::array<std::size_t, 6> width{};
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  const bool has_units = std::any_of(deviations.begin(), deviations.end(), [](auto& d) { return !d.unit.empty(); });
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("{:<{}}  {:<{}}  {:>{}}  {:>{}}  {:>{}}", row[0], width[0], row[1], width[1], row[2], width[2],
                        row[3], width[3], row[4], width[4]);
    if (has_units) text += "  " + row[5];
    text += "\n";
  }
  if (!deviations.empty()) {
    const Deviation& d = deviations.front();
    text += fmt::format("Compared at {} {} from {:g} to {:g}; the RMS of the reference is {:.3e}.\n", d.instants,
                        d.channel.starts_with("modes/") ? "modes" : "instants", d.from, d.to, d.reference_rms);
  }
  return text;
}

}  // namespace tisserand::mechanism

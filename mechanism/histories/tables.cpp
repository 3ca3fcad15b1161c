// SPDX-License-Identifier: GPL-3.0-or-later
// Lists and exports channels, and compares runs with reference histories.
#include "mechanism/histories/tables.hpp"

#include <algorithm>
#include <array>

#include "common/error.hpp"
#include "common/text.hpp"
#include "common/units.hpp"

namespace tisserand::mechanism {

std::string channels_table(const std::string& file, const std::vector<std::string>& patterns) {
  const formats::ResultsReader reader(file);
  const std::vector<double> time = reader.time();
  const auto count = [](std::size_t n, const char* noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); };
  std::string text = fmt::format("{}: scene '{}', {}", file, reader.scene(), count(time.size(), "instant"));
  const std::string unit = after_time(reader.layout().units);
  if (time.size() == 1) text += fmt::format(" at {:g}{}", time.front(), unit);
  if (time.size() > 1) text += fmt::format(" from {:g} to {:g}{}", time.front(), time.back(), unit);
  if (reader.modes() > 0) text += ", " + count(reader.modes(), "mode");
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

std::vector<Series> compare(const SeriesRequest& request, const TimeWindow& window) {
  const std::size_t references = request.references.size() + request.reference_runs.size();
  if (references != 1)
    throw Error(fmt::format("{} references, but exactly one is needed", references), "compare",
                "name it with --reference file.csv:t:column, or --reference other.results.h5");
  const std::vector<Series> all = read_series(request);
  std::vector<Series> differences;
  for (const Series& series : all) {
    if (series.kind != SeriesKind::run) continue;
    const Series& reference = reference_of(series, all);
    differences.push_back(reference.is_of_run ? difference(series, reference, window)
                                              : difference_at_reference(series, reference, window));
  }
  return differences;
}

std::string deviations_table(const std::vector<Series>& differences) {
  std::vector<std::array<std::string, 6>> rows = {{"run", "channel", "max error", "RMS error", "relative RMS", "unit"}};
  for (const Series& one : differences) {
    const Deviation& d = one.norms;
    rows.push_back({one.source, one.channel, fmt::format("{:.3e}", d.largest), fmt::format("{:.3e}", d.rms),
                    d.reference_rms > 0.0 ? fmt::format("{:.2f} %", 100.0 * d.rms / d.reference_rms) : "-", one.unit});
  }
  std::array<std::size_t, 6> width{};
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  const bool has_units = std::ranges::any_of(differences, [](const Series& one) { return !one.unit.empty(); });
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("{:<{}}  {:<{}}  {:>{}}  {:>{}}  {:>{}}", row[0], width[0], row[1], width[1], row[2], width[2],
                        row[3], width[3], row[4], width[4]);
    if (has_units) text += "  " + row[5];
    text += "\n";
  }
  if (!differences.empty()) {
    const Series& first = differences.front();
    const Deviation& d = first.norms;
    text += fmt::format("Compared at {} {} from {:g} to {:g}{}; the RMS of the reference is {:.3e}{}.\n", d.instants,
                        first.channel.starts_with("modes/") ? "modes" : "instants", d.from, d.to,
                        after_number(first.x_unit), d.reference_rms, after_number(first.unit));
  }
  return text;
}

}  // namespace tisserand::mechanism

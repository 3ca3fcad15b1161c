// SPDX-License-Identifier: GPL-3.0-or-later
// Histories from results files and CSV files, selected by channel names and columns.
#include "mechanism/histories/series.hpp"

#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/tables/text_cells.hpp"

namespace tisserand::mechanism {
namespace {

constexpr std::string_view kBlank = " \t\r\"";

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kBlank) - first + 1));
}

std::vector<std::string> cells(std::string_view line) {
  std::vector<std::string> parts;
  for (;;) {
    const auto comma = line.find(',');
    parts.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    line.remove_prefix(comma + 1);
  }
}

/// Header cell "name [unit]".
struct ColumnName {
  std::string name;
  std::string unit;
};

ColumnName split_unit(const std::string& cell) {
  const auto bracket = cell.rfind('[');
  if (bracket == std::string::npos || cell.back() != ']') return {cell, ""};
  return {trimmed(cell.substr(0, bracket)), cell.substr(bracket + 1, cell.size() - bracket - 2)};
}

/// Index of a column; `next` is the line after the header.
std::size_t find_column(const std::vector<std::string>& header, const std::string& wanted, const std::string& file,
                        const std::string& next) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < header.size(); ++i) {
    names.push_back(split_unit(header[i]).name);
    if (header[i] == wanted || names.back() == wanted) return i;
  }
  std::size_t number = 0;
  const auto [rest, code] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (code == std::errc() && rest == wanted.data() + wanted.size() && number >= 1 && number <= header.size())
    return number - 1;
  if (!formats::is_row_of_numbers(next, ',', header.size()))
    throw Error(fmt::format("there is no column '{}' among the {} columns", wanted, header.size()), file + ":1",
                "give a CSV file: names of columns, then lines of numbers");
  throw Error(fmt::format("there is no column '{}' among the {} columns", wanted, header.size()), file + ":1",
              fmt::format("give a number from 1, or a name: the nearest are {}", listed(nearest_names(wanted, names))));
}

double number(const std::string& cell, const std::string& file, std::size_t line, std::size_t column, bool in_table) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  const char* begin = cell.data() + (cell.front() == '+' ? 1 : 0);
  const char* end = cell.data() + cell.size();
  const auto [rest, code] = std::from_chars(begin, end, value);
  if (code != std::errc() || rest != end)
    throw Error(fmt::format("{} in column {} is not a number", formats::quoted_cell(cell, in_table), column + 1),
                fmt::format("{}:{}", file, line),
                "write numbers such as 1.5e-3 separated by commas, or leave the cell empty");
  return value;
}

/// For every pattern: the error of the last file without it, until some file has it.
using Misses = std::map<std::string, std::optional<Error>>;

/// Channels of a file that match the patterns. Throws Error if there are none.
std::vector<formats::Channel> chosen_channels(const std::vector<formats::Channel>& channels, const std::string& file,
                                              const std::vector<std::string>& patterns, Misses& misses) {
  std::vector<std::string> present;
  std::optional<Error> missing;
  for (const std::string& pattern : patterns) {
    try {
      (void)formats::select_channels(channels, {pattern}, file);
      present.push_back(pattern);
      misses[pattern] = std::nullopt;
    } catch (const Error& error) {
      if (!missing) missing = error;
      misses.try_emplace(pattern, error);
    }
  }
  if (present.empty()) throw *missing;
  return formats::select_channels(channels, present, file);
}

/// Appends the series of one file: the chosen channels over time, then those over the numbers of modes.
void append_run(const std::string& file, const std::string& label, const std::vector<std::string>& patterns,
                Misses& misses, std::vector<Series>& all) {
  const formats::ResultsReader reader(file);
  const std::vector<formats::Channel>& channels = reader.channels();
  std::string time_unit;
  for (const formats::Channel& channel : channels)
    if (channel.name == "time") time_unit = channel.unit;
  const std::vector<formats::Channel> meant = chosen_channels(channels, file, patterns, misses);
  std::vector<double> numbers(reader.modes());
  std::iota(numbers.begin(), numbers.end(), 1.0);
  const std::vector<double> time = reader.time();
  for (const formats::Rows rows : {formats::Rows::instants, formats::Rows::modes}) {
    const bool of_modes = rows == formats::Rows::modes;
    std::vector<std::string> names;
    std::vector<Series> chosen;
    for (const formats::Channel& channel : meant) {
      if (channel.name == "time" || channel.rows != rows) continue;
      names.push_back(channel.name);
      Series series;
      series.source = label.empty() ? stem(file) : label;
      series.channel = channel.name;
      series.unit = channel.unit;
      series.x_name = of_modes ? "mode" : "time";
      series.x_unit = of_modes ? "" : time_unit;
      series.x = of_modes ? numbers : time;
      series.has_own_label = !label.empty();
      chosen.push_back(std::move(series));
    }
    if (names.empty()) continue;
    const Eigen::MatrixXd values = reader.read_rows(names, 0, of_modes ? reader.modes() : reader.rows());
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const auto column = values.col(i);
      chosen[i].y.assign(column.begin(), column.end());
      all.push_back(std::move(chosen[i]));
    }
  }
}

/// Channels of the reference run with the names of those of `runs`. Throws Error if one is missing.
std::vector<Series> read_reference_run(const ComparedRun& reference, const std::vector<Series>& runs) {
  std::set<std::string> known;
  std::vector<std::string> names;
  for (const Series& run : runs)
    if (known.insert(run.channel).second) names.push_back(run.channel);
  Misses misses;
  std::vector<Series> all;
  append_run(reference.file, reference.label, names, misses, all);
  for (const auto& [pattern, error] : misses)
    if (error) throw *error;
  for (Series& one : all) {
    one.kind = SeriesKind::reference;
    one.is_of_run = true;
  }
  return all;
}

}  // namespace

std::string stem(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  const auto dot = name.find('.', 1);
  return dot == std::string::npos ? name : name.substr(0, dot);
}

ReferenceColumn parse_reference(const std::string& text) {
  const auto ending = text.find(".csv:");
  const auto first = ending == std::string::npos ? text.find(':') : ending + 4;
  const auto second = first == std::string::npos ? first : text.find(':', first + 1);
  if (second == std::string::npos)
    throw Error("'" + text + "' does not name two columns of a CSV file", "--reference",
                "write file.csv:x:y or file.csv:x:y:label, for example history.csv:t:wz_base:converged; or a results file");
  const auto third = text.find(':', second + 1);
  ReferenceColumn column{text.substr(0, first), text.substr(first + 1, second - first - 1),
                         text.substr(second + 1, third == std::string::npos ? third : third - second - 1), ""};
  column.label = third == std::string::npos ? stem(column.file) : text.substr(third + 1);
  return column;
}

std::optional<ComparedRun> parse_reference_run(const std::string& text) {
  constexpr std::string_view ending = ".h5";
  for (std::size_t at = text.find(ending); at != std::string::npos; at = text.find(ending, at + 1)) {
    const std::size_t end = at + ending.size();
    if (end == text.size()) return ComparedRun{text, stem(text)};
    if (text[end] == ':') return ComparedRun{text.substr(0, end), text.substr(end + 1)};
  }
  return {};
}

Series read_reference(const ReferenceColumn& column) {
  std::ifstream stream(column.file);
  if (!stream) throw Error("cannot be read", column.file, std::strerror(errno));
  std::string line;
  if (!std::getline(stream, line)) throw Error("is empty", column.file, "the first line must name the columns");
  const std::vector<std::string> header = cells(line);
  const std::istream::pos_type begin = stream.tellg();
  std::string next;
  std::getline(stream, next);
  const std::size_t x = find_column(header, column.x, column.file, next);
  const std::size_t y = find_column(header, column.y, column.file, next);
  stream.clear();
  stream.seekg(begin);

  Series series;
  series.kind = SeriesKind::reference;
  series.source = column.label;
  series.channel = split_unit(header[y]).name;
  series.unit = split_unit(header[y]).unit;
  series.x_name = split_unit(header[x]).name;
  series.x_unit = split_unit(header[x]).unit;
  for (std::size_t number_of_line = 2; std::getline(stream, line); ++number_of_line) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> row = cells(line);
    if (row.size() != header.size())
      throw Error(fmt::format("{} cells, but the header has {}", row.size(), header.size()),
                  fmt::format("{}:{}", column.file, number_of_line), "every row needs one cell per column");
    const bool in_table = !series.x.empty();
    const double at = number(row[x], column.file, number_of_line, x, in_table);
    const double value = number(row[y], column.file, number_of_line, y, in_table);
    if (std::isnan(at) || std::isnan(value)) continue;
    series.x.push_back(at);
    series.y.push_back(value);
  }
  return series;
}

std::vector<Series> read_series(const SeriesRequest& request) {
  if (request.files.empty() && (request.references.empty() || !request.reference_runs.empty()))
    throw Error("no file to read", "", "name a results file, or a CSV file with --reference file.csv:x:y");
  if (!request.files.empty() && request.channels.empty())
    throw Error("no channel chosen", request.files.front(),
                "add --channel <name>; `mechanism channels " + request.files.front() + "` lists them");
  if (request.labels.size() > request.files.size())
    throw Error(fmt::format("{} labels for {} files", request.labels.size(), request.files.size()), "--label",
                "give at most one label per results file; a reference has its own as file.csv:x:y:label");
  std::vector<Series> all;
  Misses misses;
  for (std::size_t i = 0; i < request.files.size(); ++i)
    append_run(request.files[i], i < request.labels.size() ? request.labels[i] : "", request.channels, misses, all);
  for (const auto& [pattern, error] : misses)
    if (error) throw *error;
  std::vector<Series> others;
  for (const ComparedRun& reference : request.reference_runs)
    for (Series& one : read_reference_run(reference, all)) others.push_back(std::move(one));
  all.insert(all.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
  for (const ReferenceColumn& column : request.references) all.push_back(read_reference(column));
  return all;
}

}  // namespace tisserand::mechanism

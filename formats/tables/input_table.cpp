// SPDX-License-Identifier: GPL-3.0-or-later
// Reads times and values from columns or datasets.
#include "formats/tables/input_table.hpp"

#include <charconv>
#include <cstring>
#include <fstream>
#include <string_view>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/hdf5/file.hpp"
#include "formats/tables/text_cells.hpp"

namespace tisserand::formats {
namespace {

constexpr std::size_t most_points = 10'000'000;
constexpr const char* csv_or_hdf5 = "give a csv or HDF5 file";

/// Index of a column by its number or name. `is_header` returns whether the line names columns; messages list them.
template <class IsHeader>
std::size_t find_column(const std::vector<std::string_view>& header, const std::string& wanted,
                        const std::string& where, const IsHeader& is_header) {
  std::size_t number = 0;
  const auto [stop, status] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (status == std::errc{} && stop == wanted.data() + wanted.size() && number >= 1 && number <= header.size())
    return number - 1;
  for (std::size_t i = 0; i < header.size(); ++i)
    if (header[i] == wanted) return i;
  if (!is_header())
    throw Error(fmt::format("there is no column '{}'", wanted), where,
                fmt::format("give a table: this line has {}, and no line of numbers follows",
                            header.size() == 1 ? "1 cell" : fmt::format("{} cells", header.size())));
  std::vector<std::string> names;
  for (const std::string_view name : header) names.emplace_back(printable_line(name, 40));
  const std::optional<std::string> near = nearest(wanted, names);
  throw Error(
      fmt::format("there is no column '{}'", wanted), where,
      near ? fmt::format("did you mean '{}'?", *near)
           : fmt::format("use one of its {} columns, by name or by number from 1: {}", names.size(), listed(names)));
}

double read_cell(const std::vector<std::string_view>& cells, std::size_t column, const std::string& where,
                 bool in_table) {
  double value = 0.0;
  if (column >= cells.size())
    throw Error(fmt::format("the line has {} cells, but column {} is needed", cells.size(), column + 1), where, "");
  if (!read_finite(cells[column], value))
    throw Error(fmt::format("{} in column {} is not a finite number", quoted_cell(cells[column], in_table), column + 1),
                where, "");
  return value;
}

TimeTable read_text_table(const InputPlace& place) {
  std::ifstream stream = open_table(place.file, csv_or_hdf5);
  TimeTable table;
  std::string line;
  bool started = false;
  char separator = ' ';
  std::size_t time = 0, value = 0;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    const std::string where = fmt::format("{}:{}", place.file, number);
    if (!started) separator = separator_of(line);
    const std::vector<std::string_view> cells = split_cells(line, separator);
    if (!started) {
      started = true;
      const auto is_header = [&] {
        std::string next;
        while (std::getline(stream, next) && trimmed(next).empty()) continue;
        return is_row_of_numbers(line, separator, cells.size()) || is_row_of_numbers(next, separator, cells.size());
      };
      time = find_column(cells, place.time, where, is_header);
      value = find_column(cells, place.value, where, is_header);
      double first = 0.0;
      if (!read_finite(cells[time], first) && !read_finite(cells[value], first)) continue;  // a line of names
    }
    const bool in_table = !table.time.empty();
    table.time.push_back(read_cell(cells, time, where, in_table));
    table.value.push_back(read_cell(cells, value, where, in_table));
    if (table.time.size() > most_points)
      throw Error(fmt::format("has more than {} points", most_points), place.file, "reduce the number of points");
  }
  return table;
}

std::vector<double> read_dataset(const hdf5::InputFile& file, const std::string& name) {
  const std::string dataset = name.starts_with('/') ? name : "/" + name;
  const hdf5::DatasetInfo info = file.info(dataset);
  if (info.shape.size() != 1 || info.shape[0] > most_points)
    throw Error(fmt::format("dataset {} has the shape {}", dataset, hdf5::shape_text(info.shape)), file.path(),
                fmt::format("give a one-dimensional dataset of at most {} numbers", most_points));
  std::vector<double> values(info.shape[0]);
  file.read(dataset, info.shape, "points", values.data());
  return values;
}

TimeTable read_hdf5_table(const InputPlace& place) {
  const hdf5::InputFile file(place.file, hdf5::Completeness::closed);
  TimeTable table{read_dataset(file, place.time), read_dataset(file, place.value)};
  if (table.time.size() != table.value.size())
    throw Error(
        fmt::format("{} has {} points, but {} has {}", place.time, table.time.size(), place.value, table.value.size()),
        place.file, "give datasets of equal length");
  return table;
}

bool is_hdf5(const std::string& path) {
  std::ifstream stream = open_table(path, csv_or_hdf5);
  char bytes[8] = {};
  stream.read(bytes, sizeof bytes);
  return stream.gcount() == 8 && std::memcmp(bytes, "\x89HDF\r\n\x1a\n", 8) == 0;
}

}  // namespace

TimeTable read_input_table(const InputPlace& place) {
  return is_hdf5(place.file) ? read_hdf5_table(place) : read_text_table(place);
}

}  // namespace tisserand::formats

// SPDX-License-Identifier: GPL-3.0-or-later
// Reads times and values from the lines of a CSV file.
#include "formats/tables/csv_table.hpp"

#include <fstream>
#include <vector>

#include "common/error.hpp"
#include "formats/tables/text_cells.hpp"

namespace tisserand::formats {
namespace {

struct Cell {
  std::size_t column;  ///< from 0
  std::string text;
};

std::vector<Cell> split(const std::string& line) {
  std::vector<Cell> cells;
  constexpr const char* separators = ",; \t\r";
  for (std::size_t i = line.find_first_not_of(separators); i != std::string::npos;) {
    const std::size_t end = std::min(line.find_first_of(separators, i), line.size());
    cells.push_back({i, line.substr(i, end - i)});
    i = line.find_first_not_of(separators, end);
  }
  return cells;
}

}  // namespace

TimeTable read_csv_table(const std::string& path) {
  std::ifstream stream = open_table(path, "give a csv file with the columns time and value");
  TimeTable table;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::vector<Cell> cells = split(line);
    if (cells.empty() || cells[0].text[0] == '#') continue;
    std::vector<double> values(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (read_finite(cells[i].text, values[i])) continue;
      if (table.time.empty() && i == 0) {
        values.clear();
        break;
      }
      throw Error(fmt::format("{} is not a finite number", quoted_cell(cells[i].text, !table.time.empty())),
                  fmt::format("{}:{}:{}", path, number, cells[i].column + 1), "give two numbers per line: time, value");
    }
    if (values.empty()) continue;
    if (values.size() != 2)
      throw Error(fmt::format("the line has {} numbers instead of 2", values.size()),
                  fmt::format("{}:{}:1", path, number), "give two numbers per line: time, value");
    table.time.push_back(values[0]);
    table.value.push_back(values[1]);
  }
  if (table.time.empty()) throw Error("the table has no line with two numbers", path, "give lines such as 0.2, 200");
  return table;
}

}  // namespace tisserand::formats

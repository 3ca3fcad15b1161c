// SPDX-License-Identifier: GPL-3.0-or-later
// Reads axes and heights from the lines of a table.
#include "formats/roads/height_grid_file.hpp"

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/tables/text_cells.hpp"

namespace tisserand::formats {
namespace {

using Cells = std::vector<std::string_view>;

constexpr const char* no_holes = "give a height at each point of the grid";

/// Parser of the table, which receives its lines one by one.
class GridLines {
 public:
  GridLines(const std::string& path, const std::optional<RegularGrid>& regular) : path_(path), regular_(regular) {}

  void add(std::string_view line, int number) {
    where_ = fmt::format("{}:{}", path_, number);
    const std::string_view text = trimmed(line);
    if (text.starts_with('#')) return;
    if (text.empty()) {
      gap_ = rows_ > 0 && gap_.empty() ? where_ : gap_;
      return;
    }
    if (!gap_.empty()) throw Error("the line is empty, but lines of heights follow", gap_, no_holes);
    if (separator_ == 0) separator_ = separator_of(text);
    const Cells cells = split_cells(line, separator_);
    if (!regular_ && columns_ == 0)
      read_axis(cells);
    else
      read_row(cells);
  }

  RoadHeights take() {
    if (rows_ < 2 || columns_ < 2)
      throw Error(fmt::format("the grid has {} x {} heights", rows_, columns_), path_,
                  "give at least two along each axis");
    if (regular_) {
      grid_.along = regular_axis(regular_->x_start, rows_);
      grid_.across = regular_axis(regular_->y_start, columns_);
    }
    grid_.height = Eigen::Map<const HeightTable>(heights_.data(), static_cast<Eigen::Index>(rows_),
                                                 static_cast<Eigen::Index>(columns_));
    return std::move(grid_);
  }

 private:
  double number(const Cells& cells, std::size_t column, const char* remedy) const {
    double value = 0.0;
    if (!read_finite(cells[column], value))
      throw Error(
          fmt::format("{} in column {} is not a finite number", quoted_cell(cells[column], rows_ > 0), column + 1),
          where_, remedy);
    return value;
  }
  void extend(std::vector<double>& axis, double value, const char* name) const {
    if (!axis.empty() && !(value > axis.back()))
      throw Error(fmt::format("{} must increase, but {:g} follows {:g}", name, value, axis.back()), where_,
                  "sort the grid");
    axis.push_back(value);
  }
  void read_axis(const Cells& cells) {
    double corner = 0.0;
    if (read_finite(cells[0], corner))
      throw Error(fmt::format("the line begins with the number {:g} instead of a word", corner), where_,
                  "write a word and then the y of each column, or give x_start, y_start and spacing in the scene");
    for (std::size_t i = 1; i < cells.size(); ++i)
      extend(grid_.across, number(cells, i, "give the y of the column"), "y");
    columns_ = grid_.across.size();
    if (columns_ < 2)
      throw Error("the line gives fewer than two values of y", where_, "give the y of each column, at least two");
  }
  void read_row(const Cells& cells) {
    const std::size_t first = regular_ ? 0 : 1;
    if (columns_ == 0) columns_ = cells.size();
    if (cells.size() != columns_ + first)
      throw Error(fmt::format("the line has {} cells instead of {}", cells.size(), columns_ + first), where_, no_holes);
    if (!regular_) extend(grid_.along, number(cells, 0, "give the x of the row"), "x");
    if (heights_.size() + columns_ > most_road_heights)
      throw Error(fmt::format("has more than {} heights", most_road_heights), path_, "reduce the number of points");
    for (std::size_t i = first; i < cells.size(); ++i) heights_.push_back(number(cells, i, no_holes));
    ++rows_;
  }
  std::vector<double> regular_axis(double start, std::size_t size) const {
    std::vector<double> axis(size);
    for (std::size_t i = 0; i < size; ++i) axis[i] = start + static_cast<double>(i) * regular_->spacing;
    return axis;
  }

  const std::string& path_;
  const std::optional<RegularGrid>& regular_;
  std::string where_, gap_;
  char separator_ = 0;
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<double> heights_;
  RoadHeights grid_;
};

}  // namespace

RoadHeights read_height_grid(const std::string& path, const std::optional<RegularGrid>& regular) {
  std::ifstream stream = open_road_file(path, "give a csv file of heights");
  GridLines lines(path, regular);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) lines.add(line, number);
  return lines.take();
}

}  // namespace tisserand::formats

// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the reference line and the heights from the records of an OpenCRG file.
#include "formats/roads/crg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/roads/crg_header.hpp"
#include "formats/tables/text_cells.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Vector2d;

constexpr std::size_t record = 80;
/// Largest closing error relative to the length: distance between the ends by the parameters and by the integral.
constexpr double largest_closing_error = 1e-3;

std::string place(const std::string& path, int line) { return fmt::format("{}:{}", path, line); }

/// Numbers in fields of a fixed width. Fields that begin with * or hold "nan" are not-a-number.
class Records {
 public:
  Records(std::istream& stream, const std::string& path, const CrgHeader& header)
      : stream_(stream), path_(path), header_(header), line_(header.line) {}

  /// Reads the numbers of the next row, which may fill several lines. False at the end.
  bool next(std::vector<double>& row) {
    const std::size_t width = static_cast<std::size_t>(header_.width), in_line = record / width;
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c % in_line == 0 && !next_line()) {
        if (c == 0) return false;
        throw Error(fmt::format("the file ends inside a row: it has {} of {} columns", c, row.size()),
                    place(path_, line_), "write the file again");
      }
      const std::size_t first = c % in_line * width;
      row[c] = field(std::string_view(text_).substr(std::min(first, text_.size()), width), first);
    }
    return true;
  }
  int line() const { return line_; }

 private:
  /// Reads the next line. False at the end of the file, also after trailing empty lines.
  bool next_line() {
    while (std::getline(stream_, text_)) {
      ++line_;
      text_.resize(trimmed(text_).empty() ? 0 : text_.find_last_not_of(" \t\r") + 1);
      if (text_.size() > record)
        throw Error(fmt::format("the line has {} characters; the limit is {}", text_.size(), record),
                    place(path_, line_), "write lines of at most 80 characters");
      if (text_.empty()) {
        empty_ = empty_ == 0 ? line_ : empty_;
        continue;
      }
      if (empty_ != 0) throw Error("the line is empty, but data follow", place(path_, empty_), "write the file again");
      return true;
    }
    return false;
  }

  double field(std::string_view characters, std::size_t first) const {
    std::string word(trimmed(characters));
    if (word.starts_with('*') || word == "nan" || word == "NaN" || word == "NAN")
      return std::numeric_limits<double>::quiet_NaN();
    for (char& c : word)
      if (c == 'D' || c == 'd') c = 'e';
    double value = 0.0;
    if (!read_finite(word, value))
      throw Error(fmt::format("'{}' is not a finite number", printable_line(trimmed(characters), 40)),
                  fmt::format("{}:{}", place(path_, line_), first + 1),
                  fmt::format("give numbers of {} characters; write *missing* for a missing number", header_.width));
    return value;
  }

  std::istream& stream_;
  const std::string& path_;
  const CrgHeader& header_;
  std::string text_;
  int line_, empty_ = 0;
};

/// Rows in the order of the file.
struct CrgData {
  std::vector<double> heading, slope, banking;  ///< per row; empty if there is no such column
  std::vector<double> heights;                  ///< rows × columns of sections, in the order of the file
  std::vector<int> lines;                       ///< number of the last line of each row
};

CrgData read_rows(std::istream& stream, const std::string& path, const CrgHeader& header) {
  CrgData data;
  Records records(stream, path, header);
  std::vector<double> row(header.columns.size());
  while (records.next(row)) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      switch (header.columns[c].kind) {
        case CrgColumn::Kind::heading:
          data.heading.push_back(row[c]);
          break;
        case CrgColumn::Kind::slope:
          data.slope.push_back(row[c]);
          break;
        case CrgColumn::Kind::banking:
          data.banking.push_back(row[c]);
          break;
        case CrgColumn::Kind::section:
          data.heights.push_back(row[c]);
          break;
      }
    }
    data.lines.push_back(records.line());
    if (data.heights.size() > most_road_heights)
      throw Error(fmt::format("has more than {} heights", most_road_heights), path, "reduce the number of points");
  }
  return data;
}

/// Positions v of the sections in the order of the file.
std::vector<double> section_positions(const CrgHeader& header, const std::string& path) {
  std::vector<const CrgColumn*> sections;
  for (const CrgColumn& column : header.columns)
    if (column.kind == CrgColumn::Kind::section) sections.push_back(&column);
  if (sections.size() < 2)
    throw Error(fmt::format("the number of long sections (columns of heights) is {}", sections.size()), path,
                "give two or more");
  const double between = header.value("long_section_v_increment", 0.01);
  const double right = header.value("long_section_v_right", -0.5 * between * static_cast<double>(sections.size() - 1));
  std::vector<double> v;
  for (const CrgColumn* section : sections) {
    if (section->numbered != sections[0]->numbered)
      throw Error("some long sections are given by number, others by position", place(path, section->line),
                  "use one form for all");
    const double number = static_cast<double>(v.size() + 1);
    if (section->numbered && section->position != number)
      throw Error(fmt::format("long section {:g} is given where {:g} is expected", section->position, number),
                  place(path, section->line), "number the long sections from 1, beginning at the right");
    v.push_back(section->numbered ? right + (number - 1.0) * between : section->position);
  }
  const auto [least, most] = std::ranges::minmax(v);
  for (const auto& [name, value] : {std::pair{"long_section_v_right", least}, std::pair{"long_section_v_left", most}})
    if (const auto given = header.parameters.find(name);
        given != header.parameters.end() && std::abs(given->second.value - value) > 1e-3)
      throw Error(fmt::format("{} = {:g}, but the outermost long section on this side is at {:g}", name,
                              given->second.value, value),
                  place(path, given->second.line), "correct one of them");
  return v;
}

double size_of(double d) { return std::abs(d); }
double size_of(const Vector2d& d) { return d.norm(); }

/// Adds the closing error in proportion to the distance, as the weighted mean of forward and backward integration does.
/// `end`: end by the parameters.
template <class Value>
void distribute_closing_error(std::vector<Value>& points, const Value& end, double length, const char* what,
                              const std::string& where) {
  const Value error = end - points.back();
  if (!(size_of(error) <= largest_closing_error * length))
    throw Error(fmt::format("the end computed from the {} is {:g} m away from the end that the parameters give", what,
                            size_of(error)),
                where, "correct the parameters of the end, or remove them");
  const double last = static_cast<double>(points.size() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += error * (static_cast<double>(i) / last);
}

void require_values(const std::vector<double>& values, std::size_t first, const char* what, const CrgData& data,
                    const std::string& path) {
  for (std::size_t i = first; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw Error(fmt::format("the {} is missing", what), place(path, data.lines[i]),
                  first == 0 ? "give it in every row" : "give it in every row but the first");
}

Eigen::Matrix2Xd reference_line(const CrgHeader& header, const CrgData& data, const std::string& path) {
  const bool straight = data.heading.empty();
  const double phi = header.value("reference_line_start_phi", 0.0);
  const double length = header.increment * static_cast<double>(data.lines.size() - 1);
  std::vector<Vector2d> points{
      {header.value("reference_line_start_x", 0.0), header.value("reference_line_start_y", 0.0)}};
  if (straight) points.push_back(points[0] + length * Vector2d(std::cos(phi), std::sin(phi)));
  for (std::size_t i = 1; i < data.heading.size(); ++i)
    points.push_back(points.back() + header.increment * Vector2d(std::cos(data.heading[i]), std::sin(data.heading[i])));
  if (header.has("reference_line_end_x") != header.has("reference_line_end_y"))
    throw Error("only one of reference_line_end_x and reference_line_end_y is given", path, "give both or none");
  if (header.has("reference_line_end_x"))
    distribute_closing_error(
        points, Vector2d(header.value("reference_line_end_x", 0.0), header.value("reference_line_end_y", 0.0)), length,
        "heading", place(path, header.parameters.at("reference_line_end_x").line));
  Eigen::Matrix2Xd line(2, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) line.col(static_cast<Eigen::Index>(i)) = points[i];
  return line;
}

/// Value of a parameter that is constant along the line, if the data have no column of it.
double constant(const CrgHeader& header, const std::string& start, const std::string& end, const std::string& path) {
  const double value = header.value(start, 0.0);
  if (header.has(end) && header.value(end, 0.0) != value)
    throw Error(fmt::format("{} = {:g} differs from {} = {:g}, but the data have no column for this quantity", end,
                            header.value(end, 0.0), start, value),
                place(path, header.parameters.at(end).line), "add the column, or give equal values");
  return value;
}

/// z of the reference line per row: integral of the slope.
std::vector<double> reference_heights(const CrgHeader& header, const CrgData& data, const std::string& path) {
  const double slope =
      data.slope.empty() ? constant(header, "reference_line_start_s", "reference_line_end_s", path) : 0.0;
  const double start = header.value("reference_line_start_z", 0.0);
  std::vector<double> z{start};
  for (std::size_t i = 1; i < data.lines.size(); ++i)
    z.push_back(data.slope.empty() ? start + slope * header.increment * static_cast<double>(i)
                                   : z.back() + header.increment * data.slope[i]);
  if (header.has("reference_line_end_z"))
    distribute_closing_error(z, header.value("reference_line_end_z", 0.0),
                             header.increment * static_cast<double>(data.lines.size() - 1), "slope",
                             place(path, header.parameters.at("reference_line_end_z").line));
  return z;
}

/// Fills heights, with sections from right to left: sum of the grid, the line and banking · v.
void fill_heights(const CrgHeader& header, const CrgData& data, const std::string& path, RoadHeights& road) {
  const std::vector<double> v = section_positions(header, path), z = reference_heights(header, data, path);
  std::vector<std::size_t> order(v.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::sort(order, {}, [&v](std::size_t k) { return v[k]; });
  for (const std::size_t k : order) {
    if (!road.across.empty() && !(v[k] - road.across.back() > 1e-6))
      throw Error(fmt::format("two long sections are at v = {:g}", v[k]), path, "remove one");
    road.across.push_back(v[k]);
  }
  const double banking =
      data.banking.empty() ? constant(header, "reference_line_start_b", "reference_line_end_b", path) : 0.0;
  road.height.resize(static_cast<Eigen::Index>(data.lines.size()), static_cast<Eigen::Index>(v.size()));
  for (std::size_t i = 0; i < data.lines.size(); ++i)
    for (std::size_t k = 0; k < v.size(); ++k)
      road.height(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          data.heights[i * v.size() + order[k]] + z[i] +
          (data.banking.empty() ? banking : data.banking[i]) * road.across[k];
}

void check_rows(const CrgHeader& header, const CrgData& data, const std::string& path) {
  if (data.lines.size() < 2)
    throw Error(fmt::format("the number of rows of data is {}", data.lines.size()), path, "give two or more");
  const double end = header.u_start + header.increment * static_cast<double>(data.lines.size() - 1);
  if (const auto given = header.parameters.find("reference_line_end_u");
      given != header.parameters.end() && std::abs(given->second.value - end) > 0.5 * header.increment)
    throw Error(fmt::format("reference_line_end_u = {:g}, but {} rows of data end at u = {:g}", given->second.value,
                            data.lines.size(), end),
                place(path, given->second.line), "write the file again, or correct the end");
  // The first value of heading and slope belongs to no interval.
  require_values(data.heading, 1, "reference line phi", data, path);
  require_values(data.slope, 1, "reference line slope", data, path);
  require_values(data.banking, 0, "reference line banking", data, path);
  if (std::ranges::none_of(data.heights, [](double z) { return std::isfinite(z); }))
    throw Error("all heights are missing", path, "write the file again");
}

}  // namespace

RoadHeights read_crg(const std::string& path) {
  std::ifstream stream = open_road_file(path, "give an OpenCRG file");
  const CrgHeader header = read_crg_header(stream, path);
  CrgData data = read_rows(stream, path, header);
  check_rows(header, data, path);
  RoadHeights road;
  for (std::size_t i = 0; i < data.lines.size(); ++i)
    road.along.push_back(header.u_start + header.increment * static_cast<double>(i));
  road.line = reference_line(header, data, path);
  fill_heights(header, data, path, road);
  if (header.moved_at != 0 && !(road.line.col(0).isZero(0.0) && header.value("reference_line_start_phi", 0.0) == 0.0 &&
                                header.value("reference_line_start_z", 0.0) == 0.0))
    throw Error(
        "the modifiers refpoint_... would move the start of the reference line to the origin, which is not supported",
        place(path, header.moved_at), "remove them and place the road by the pose in the scene");
  return road;
}

}  // namespace tisserand::formats

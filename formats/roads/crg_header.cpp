// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the sections and keywords of the head of an OpenCRG file.
#include "formats/roads/crg_header.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/tables/text_cells.hpp"

namespace tisserand::formats {
namespace {

/// Accepted values of a keyword.
enum class CrgRule { used, unused, zero, one, zero_or_two, zero_moves };
using CrgKeywords = std::map<CrgRule, std::vector<std::string_view>>;

const CrgKeywords road_keywords{
    {CrgRule::used,
     {"reference_line_start_u", "reference_line_end_u", "reference_line_increment", "reference_line_start_x",
      "reference_line_start_y", "reference_line_start_z", "reference_line_start_phi", "reference_line_end_x",
      "reference_line_end_y", "reference_line_end_z", "reference_line_start_b", "reference_line_end_b",
      "reference_line_start_s", "reference_line_end_s", "long_section_v_right", "long_section_v_left",
      "long_section_v_increment"}},
    {CrgRule::unused,
     {"reference_line_end_phi", "reference_line_start_lon", "reference_line_start_lat", "reference_line_start_alt",
      "reference_line_end_lon", "reference_line_end_lat", "reference_line_end_alt"}},
    {CrgRule::zero,
     {"reference_line_offset_x", "reference_line_offset_y", "reference_line_offset_z", "reference_line_offset_phi"}}};

const CrgKeywords option_keywords{
    {CrgRule::zero_or_two, {"border_mode_u", "border_mode_v"}},
    {CrgRule::zero,
     {"border_offset_u", "border_offset_v", "border_smooth_ubeg", "border_smooth_uend", "refline_continuation"}},
    {CrgRule::unused,
     {"refline_search_far", "refline_search_close", "refline_search_u", "refline_search_ufrac", "warn_msgs",
      "warn_curv_local", "warn_curv_global", "log_msgs", "log_eval", "log_eval_freq", "log_hist", "log_hist_freq",
      "log_stat", "log_stat_freq", "check_eps", "check_inc", "check_tol", "check_pro", "check_wgs"}}};

const CrgKeywords modifier_keywords{
    {CrgRule::one, {"scale_z_grid", "scale_slope", "scale_banking", "scale_length", "scale_width", "scale_curvature"}},
    {CrgRule::zero_or_two, {"grid_nan_mode"}},
    {CrgRule::zero,
     {"grid_nan_offset", "refline_offset_phi", "refline_offset_x", "refline_offset_y", "refline_offset_z"}},
    {CrgRule::unused, {"refline_rotcenter_x", "refline_rotcenter_y"}},
    {CrgRule::zero_moves,
     {"refpoint_u_fraction", "refpoint_u_offset", "refpoint_u", "refpoint_v_fraction", "refpoint_v_offset",
      "refpoint_v", "refpoint_x", "refpoint_y", "refpoint_z", "refpoint_phi"}}};

std::string small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

bool allows(CrgRule rule, double value) {
  switch (rule) {
    case CrgRule::used:
    case CrgRule::unused:
      return true;
    case CrgRule::zero:
    case CrgRule::zero_moves:
      return value == 0.0;
    case CrgRule::one:
      return value == 1.0;
    case CrgRule::zero_or_two:
      return value == 0.0 || value == 2.0;
  }
  return false;
}

/// Parser of the head, which receives its lines one by one.
class HeaderLines {
 public:
  explicit HeaderLines(const std::string& path) : path_(path) {}

  /// Adds a line. False for the final line $$$$.
  bool add(std::string_view line) {
    ++header_.line;
    if (line.starts_with("$$$$")) return false;
    const std::string_view text = trimmed(line.substr(0, line.find('!')));
    if (line.starts_with('$'))
      change_section(text.substr(1));
    else if (section_ != "ct" && !text.empty() && !text.starts_with('*'))
      read_line(text);
    return true;
  }

  CrgHeader take() {
    if (header_.columns.empty())
      throw Error("has no columns of data (D: lines in $KD_Definition)", path_, "give an OpenCRG file with its data");
    header_.u_start = header_.value("reference_line_start_u", u_start_.value_or(0.0));
    header_.increment = header_.value("reference_line_increment", increment_.value_or(0.0));
    for (const auto& [line, other, own] :
         {std::tuple{u_line_, u_start_, header_.u_start}, std::tuple{u_line_, increment_, header_.increment}})
      if (other && std::abs(*other - own) > 1e-6 * std::abs(own))
        throw Error(
            fmt::format("the line U: gives {:g}, but the parameters of the reference line give {:g}", *other, own),
            where(line), "correct one of them");
    if (!(header_.increment > 1e-6))
      throw Error(fmt::format("REFERENCE_LINE_INCREMENT {:g} must be greater than 1e-6 m", header_.increment), path_,
                  "give it in $ROAD_CRG");
    return std::move(header_);
  }

 private:
  std::string where(int line) const { return fmt::format("{}:{}", path_, line); }
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw Error(what, where(header_.line), remedy);
  }

  void change_section(std::string_view rest) {
    const std::string name = small_letters(trimmed(rest.substr(0, rest.find_first_of(" \t"))));
    if (name.empty()) {
      section_.clear();
      return;
    }
    if (!section_.empty())
      fail(fmt::format("section ${} begins inside section ${}", printable_line(name, 40), section_),
           "end the previous section with a line $");
    if (name == "road_crg_file")
      fail("$ROAD_CRG_FILE refers to another file, which is not supported", "give the path of that file in the scene");
    const std::vector<std::string> known{"ct",           "road_crg", "road_crg_opts", "road_crg_mods", "road_crg_mpro",
                                         "kd_definition"};
    if (std::ranges::find(known, name) == known.end())
      fail(fmt::format("the section ${} is not known", printable_line(name, 40)), "remove it");
    section_ = name;
  }

  void read_line(std::string_view text) {
    if (section_ == "road_crg")
      read_parameter(text, road_keywords);
    else if (section_ == "road_crg_opts")
      read_parameter(text, option_keywords);
    else if (section_ == "road_crg_mods")
      read_parameter(text, modifier_keywords);
    else if (section_ == "kd_definition")
      read_definition(text);
    else if (section_.empty())
      fail("the line is outside all sections",
           "begin comments with * and sections with $; check that this is an OpenCRG file");
  }

  double number(std::string_view text, std::string_view keyword) const {
    double value = 0.0;
    if (!read_finite(trimmed(text), value))
      fail(fmt::format("{}: '{}' is not a finite number", keyword, printable_line(trimmed(text), 40)), "");
    return value;
  }

  void read_parameter(std::string_view text, const CrgKeywords& keywords) {
    const std::size_t equals = text.find('=');
    const std::string name = small_letters(trimmed(text.substr(0, equals)));
    const auto known = std::ranges::find_if(
        keywords, [&](const auto& one) { return std::ranges::find(one.second, name) != one.second.end(); });
    if (known == keywords.end()) {
      std::vector<std::string> names;
      for (const auto& [rule, words] : keywords) names.insert(names.end(), words.begin(), words.end());
      const auto near = nearest(name.substr(0, 60), names);
      fail(fmt::format("the keyword '{}' is not known in ${}", printable_line(name, 60), section_),
           near ? fmt::format("did you mean '{}'?", *near) : "remove it");
    }
    if (equals == std::string_view::npos)
      fail(fmt::format("{} has no value", name), fmt::format("write {} = <number>", name));
    const double value = number(text.substr(equals + 1), name);
    if (!allows(known->first, value))
      fail(fmt::format("{} = {:g} is not supported: only the value that has no effect is", name, value),
           "remove it, or change the data instead. The pose in the scene places the road, which ends at its borders");
    if (known->first == CrgRule::zero_moves && header_.moved_at == 0) header_.moved_at = header_.line;
    if (known->first != CrgRule::used) return;
    if (!header_.parameters.emplace(name, CrgHeader::Parameter{value, header_.line}).second)
      fail(fmt::format("{} is given twice", name), "remove one");
  }

  /// Reads a line #:, U: or D:.
  void read_definition(std::string_view text) {
    if (text.starts_with("#:")) return read_format(trimmed(text.substr(2)));
    const bool dependent = text.starts_with("D:");
    if (!dependent && !text.starts_with("U:"))
      fail(fmt::format("'{}' is not a definition of data", printable_line(text, 40)),
           "begin the line with #:, U: or D:");
    const std::vector<std::string_view> cells = split_cells(text.substr(2), ',');
    if (cells.size() < 2)
      fail(fmt::format("'{}' has no unit", printable_line(text, 40)), "write the unit behind a comma, for example: ,m");
    const std::string name = small_letters(cells[0]), unit = small_letters(cells[1]);
    if (dependent)
      read_column(name, unit);
    else if (name == "reference line u" && cells.size() == 4) {
      u_line_ = header_.line;
      u_start_ = number(cells[2], "U:");
      increment_ = number(cells[3], "U:");
    }
  }

  void read_format(std::string_view format) {
    const std::string word = small_letters(format);
    if (word == "krbi" || word == "kdbi")
      fail(fmt::format("the data are binary ({})", printable_line(format, 20)),
           "convert the file to the text format #:LRFI or #:LDFI, for example with crg_write of the OpenCRG tools");
    if (word != "lrfi" && word != "ldfi")
      fail(fmt::format("the data format '{}' is not known", printable_line(format, 20)), "use LRFI or LDFI");
    header_.width = word == "lrfi" ? 10 : 20;
    has_format_ = true;
  }

  void read_column(const std::string& name, const std::string& unit) {
    CrgColumn column;
    column.line = header_.line;
    const std::string_view section = "long section", at = "at v =";
    if (!has_format_) fail("the line D: comes before the data format", "write the line #:LRFI before it");
    if (name == "reference line phi")
      column.kind = CrgColumn::Kind::heading;
    else if (name == "reference line slope")
      column.kind = CrgColumn::Kind::slope;
    else if (name == "reference line banking")
      column.kind = CrgColumn::Kind::banking;
    else if (!name.starts_with(section))
      fail(fmt::format("the column '{}' is not known", printable_line(name, 40)),
           "use reference line phi, reference line slope, reference line banking or long section");
    const bool is_section = column.kind == CrgColumn::Kind::section;
    if (is_section) {
      const std::string_view place = trimmed(std::string_view(name).substr(section.size()));
      column.numbered = !place.starts_with(at);
      column.position = number(column.numbered ? place : place.substr(at.size()), "long section");
    } else if (std::ranges::any_of(header_.columns, [&](const CrgColumn& c) { return c.kind == column.kind; })) {
      fail(fmt::format("the column '{}' is given twice", name), "remove one");
    }
    const std::string_view expected = is_section ? "m" : column.kind == CrgColumn::Kind::heading ? "rad" : "m/m";
    if (unit != expected)
      fail(fmt::format("the column '{}' has the unit '{}' instead of {}", printable_line(name, 40),
                       printable_line(unit, 20), expected),
           "convert it");
    if (header_.columns.size() >= most_columns) fail(fmt::format("there are more than {} columns", most_columns), "");
    header_.columns.push_back(column);
  }

  static constexpr std::size_t most_columns = 100'000;
  const std::string& path_;
  CrgHeader header_;
  std::string section_;
  bool has_format_ = false;
  int u_line_ = 0;
  std::optional<double> u_start_, increment_;
};

}  // namespace

double CrgHeader::value(const std::string& name, double fallback) const {
  const auto found = parameters.find(name);
  return found == parameters.end() ? fallback : found->second.value;
}

CrgHeader read_crg_header(std::istream& stream, const std::string& path) {
  HeaderLines head(path);
  for (std::string line; std::getline(stream, line);)
    if (!head.add(line)) return head.take();
  throw Error("has no data: no line begins with $$$$", path, "give an OpenCRG file with its data");
}

}  // namespace tisserand::formats

// SPDX-License-Identifier: GPL-3.0-or-later
// Splits text tables into cells and reads their numbers.
#include "formats/tables/text_cells.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::formats {
namespace {

constexpr std::string_view blanks = " \t\r";

/// Whether the file is UTF-16, by its mark or by a zero byte in the first two characters. Rewinds the stream.
bool is_utf16(std::ifstream& stream) {
  char bytes[4] = {};
  stream.read(bytes, sizeof bytes);
  const std::string_view head(bytes, static_cast<std::size_t>(stream.gcount()));
  stream.clear();
  stream.seekg(0);
  if (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff")) return true;
  return head.size() == 4 && ((head[0] != 0 && head[1] == 0 && head[2] != 0 && head[3] == 0) ||
                              (head[0] == 0 && head[1] != 0 && head[2] == 0 && head[3] != 0));
}

}  // namespace

std::ifstream open_table(const std::string& path, const std::string& remedy) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    throw Error("is not a regular file", path, remedy);
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw Error(fmt::format("cannot open the table: {}", std::strerror(errno)), path, "check path and permission");
  if (is_utf16(stream)) throw Error("looks like UTF-16", path, "save it as UTF-8");
  return stream;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string_view> split_cells(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  line = trimmed(line);
  for (;;) {
    const std::size_t end = separator == ' ' ? line.find_first_of(blanks) : line.find(separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(separator == ' ' ? std::min(line.find_first_not_of(blanks, end), line.size()) : end + 1);
  }
}

char separator_of(std::string_view line) {
  for (const char separator : {',', ';', '\t'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

bool read_finite(std::string_view text, double& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return !text.empty() && stop == text.data() + text.size() && status == std::errc{} && std::isfinite(value);
}

std::string quoted_cell(std::string_view cell, bool in_table) {
  constexpr std::size_t longest_number = 24;
  const std::string_view after_sign = cell.substr(cell.starts_with('+') || cell.starts_with('-') ? 1 : 0);
  const bool is_word = after_sign == "nan" || after_sign == "NaN" || after_sign == "inf" || after_sign == "Inf";
  const bool is_number = cell.size() <= longest_number && cell.find_first_not_of("0123456789+-.,eEdD") == cell.npos;
  if (in_table || is_word || is_number) return fmt::format("'{}'", printable_line(cell, 40));
  return fmt::format("a text of {} characters", cell.size());
}

bool is_row_of_numbers(std::string_view line, char separator, std::size_t count) {
  const std::vector<std::string_view> cells = split_cells(line, separator);
  double value = 0.0;
  const auto numbers = std::ranges::count_if(cells, [&](std::string_view cell) { return read_finite(cell, value); });
  return cells.size() == count && read_finite(cells.front(), value) && 2 * static_cast<std::size_t>(numbers) >= count;
}

}  // namespace tisserand::formats

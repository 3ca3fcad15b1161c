// Cells and numbers of text tables.
#include "formats/tables/text_cells.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "common/error.hpp"

namespace tisserand::formats {

namespace {

constexpr std::string_view blanks = " \t\r";

}  // namespace

std::ifstream open_table(const std::string& path, const std::string& remedy) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    throw Error("is not a regular file", path, remedy);
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw Error(fmt::format("cannot open the table: {}", std::strerror(errno)), path, "check path and permission");
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

}  // namespace tisserand::formats

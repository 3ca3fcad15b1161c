// SPDX-License-Identifier: GPL-3.0-or-later
// Lines, fields and numbers of foreign text files.
#include "reducer/exchange/text_lines.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/decks/nastran/cards.hpp"
#include "reducer/decks/nastran/fields.hpp"

namespace tisserand::reducer::exchange {
namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{2} << 30;

}  // namespace

TextLines::TextLines(const std::string& path) : path_(path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    throw Error(std::filesystem::exists(path, code) ? "is not a regular file" : "does not exist", path,
                "check the path");
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code || size > most_bytes) throw Error("is larger than 2 GiB", path, "give a file of reduced matrices");
  std::ifstream stream(path, std::ios::binary);
  text_.resize(static_cast<std::size_t>(size));
  if (!stream || (size > 0 && !stream.read(text_.data(), static_cast<std::streamsize>(size))))
    throw Error(fmt::format("cannot be read: {}", std::strerror(errno)), path, "check its permissions");
}

bool TextLines::next(std::string_view& line) {
  if (at_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  line = std::string_view(text_).substr(at_, end - at_);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  at_ = end + 1;
  ++number_;
  return true;
}

std::string TextLines::where() const { return fmt::format("{}:{}", path_, number_); }

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view separators = " \t,;\r";
  for (std::size_t i = line.find_first_not_of(separators); i != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(separators, i), line.size());
    words.push_back(line.substr(i, end - i));
    i = line.find_first_not_of(separators, end);
  }
  return words;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

double number_of(std::string_view field, std::string_view what, const TextLines& lines) {
  if (const std::optional<double> value = parse_real(field)) return *value;
  throw Error(fmt::format("{} is '{}', not a finite number", what, shown(field)), lines.where(), "correct the number");
}

long integer_of(std::string_view field, std::string_view what, const TextLines& lines) {
  if (const std::optional<long> value = parse_integer(field)) return *value;
  throw Error(fmt::format("{} is '{}', not a whole number", what, shown(field)), lines.where(), "correct the number");
}

std::string start_of(std::string_view text, std::size_t length) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? "" : capitals(text.substr(first, length));
}

bool has_line(std::string_view text, std::string_view word) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = trimmed(text.substr(at, end - at));
    if (line.size() >= word.size() && same_word(line.substr(0, word.size()), word)) return true;
    at = end + 1;
  }
  return false;
}

std::string shown(std::string_view text) {
  std::string result(text.substr(0, 40));
  for (char& c : result)
    if (std::isprint(static_cast<unsigned char>(c)) == 0) c = '?';
  return result;
}

}  // namespace tisserand::reducer::exchange

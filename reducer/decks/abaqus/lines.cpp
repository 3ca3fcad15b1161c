// SPDX-License-Identifier: GPL-3.0-or-later
// Lines, keyword lines, included files and numbers of Abaqus decks.
#include "reducer/decks/abaqus/lines.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "common/error.hpp"

namespace tisserand::reducer::abaqus {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1000;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
char to_upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Short printable text for messages, with single blanks between words.
std::string shown(std::string_view text) {
  std::string result;
  for (const char c : text.substr(0, 60)) {
    if (is_blank(c) && (result.empty() || result.back() == ' ')) continue;
    result += is_blank(c) ? ' ' : c < ' ' || c > '~' ? '?' : to_upper(c);
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

std::string_view without_quotes(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return text.substr(1, text.size() - 2);
  return text;
}

/// Splits a keyword line at its commas outside quotes.
std::vector<std::string_view> split_keyword_line(std::string_view line) {
  std::vector<std::string_view> words;
  bool quoted = false;
  std::size_t start = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (line[i] != ',' || quoted)) continue;
    words.push_back(trim(line.substr(start, i - start)));
    start = i + 1;
  }
  return words;
}

Block make_block(std::string_view line) {
  const std::vector<std::string_view> words = split_keyword_line(line.substr(1));
  Block block;
  block.keyword = upper_without_blanks(words[0]);
  block.title = "*" + shown(words[0]);
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i].empty()) continue;
    const std::size_t equals = words[i].find('=');
    const std::string_view value = equals == std::string_view::npos ? "" : words[i].substr(equals + 1);
    block.parameters.push_back(
        {upper_without_blanks(words[i].substr(0, equals)), std::string(without_quotes(trim(value)))});
  }
  return block;
}

/// Converts files to blocks. The chain of open files detects circles.
class Reader {
 public:
  explicit Reader(Input& input) : input_(input) {}

  void read_file(const fs::path& path) { read_lines(path, load(path, "")); }

 private:
  /// Index of the file in Input::texts. Throws Error, because nothing useful follows a missing file.
  std::uint32_t load(const fs::path& path, const std::string& named_at) {
    const std::string where = named_at.empty() ? path.string() : named_at;
    if (input_.paths.size() >= kMostFiles)
      throw Error(fmt::format("more than {} files are included", kMostFiles), where, "include every file once");
    std::error_code none;
    if (!fs::is_regular_file(path, none))
      throw Error(fmt::format("'{}' is not a file that can be read", path.string()), where, "check the path");
    std::ifstream stream(path, std::ios::binary);
    auto text = std::make_unique<std::string>();
    if (stream) {
      text->resize(static_cast<std::size_t>(fs::file_size(path, none)));
      stream.read(text->data(), static_cast<std::streamsize>(text->size()));
      text->resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    }
    if (!stream && !stream.eof())
      throw Error(fmt::format("cannot read '{}': {}", path.string(), std::strerror(errno)), where,
                  "check the permissions of the file");
    input_.paths.push_back(path.string());
    input_.texts.push_back(std::move(text));
    return static_cast<std::uint32_t>(input_.paths.size() - 1);
  }

  void read_lines(const fs::path& path, std::uint32_t file) {
    open_.push_back(path.lexically_normal());
    std::string_view rest = *input_.texts[file];
    std::uint32_t number = 0;
    std::string continued;  // a keyword line that ends with a comma
    std::uint32_t continued_from = 0;
    while (!rest.empty()) {
      const std::size_t end = rest.find('\n');
      const std::string_view line = trim(rest.substr(0, end));
      rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
      ++number;
      if (line.starts_with("**") || (line.empty() && !keeps_blank_lines())) continue;
      if (!continued.empty() || line.starts_with('*')) {
        if (continued.empty()) continued_from = number;
        continued += line;
        if (continued.back() == ',' && !rest.empty()) continue;
        keyword_line(continued, path, file, continued_from);
        continued.clear();
      } else if (input_.blocks.empty()) {
        throw Error("this line comes before the first keyword", input_.where({line, file, number}),
                    "an Abaqus deck begins with a keyword such as *HEADING or *NODE; is the file of another format?");
      } else {
        input_.blocks.back().data.push_back({line, file, number});
      }
    }
    if (!continued.empty()) keyword_line(continued, path, file, continued_from);
    open_.pop_back();
  }

  /// Whether blank data lines are kept: in a beam section one means "default values", elsewhere it has no meaning.
  bool keeps_blank_lines() const { return !input_.blocks.empty() && input_.blocks.back().keyword.starts_with("BEAM"); }

  void keyword_line(const std::string& line, const fs::path& path, std::uint32_t file, std::uint32_t number) {
    Block block = make_block(line);
    block.file = file;
    block.line = number;
    const std::string* source = block.find("INPUT");
    if (source == nullptr) {
      if (block.keyword == "INCLUDE")
        throw Error("*INCLUDE without INPUT", input_.where(block), "write *INCLUDE, INPUT=file");
      input_.blocks.push_back(std::move(block));
      return;
    }
    const fs::path target = path.parent_path() / *source;
    const std::string where = input_.where(block);
    if (std::find(open_.begin(), open_.end(), target.lexically_normal()) != open_.end())
      throw Error(fmt::format("'{}' includes itself", target.string()), where, "remove this *INCLUDE");
    if (block.keyword != "INCLUDE") input_.blocks.push_back(std::move(block));
    read_lines(target, load(target, where));
  }

  Input& input_;
  std::vector<fs::path> open_;
};

}  // namespace

const std::string* Block::find(std::string_view name) const {
  for (const Parameter& parameter : parameters)
    if (parameter.name == name) return &parameter.value;
  return nullptr;
}

std::string Block::name_of(std::string_view parameter) const {
  const std::string* value = find(parameter);
  return value == nullptr ? "" : lower(*value);
}

std::string Block::word_of(std::string_view parameter, std::string_view if_absent) const {
  const std::string* value = find(parameter);
  return value == nullptr ? std::string(if_absent) : upper_without_blanks(*value);
}

std::string Input::where(const Block& block) const { return fmt::format("{}:{}", paths[block.file], block.line); }
std::string Input::where(const Line& line) const { return fmt::format("{}:{}", paths[line.file], line.number); }

Input read_input(const std::string& path) {
  Input input;
  Reader(input).read_file(path);
  if (input.blocks.empty())
    throw Error("the file has no keyword", path, "an Abaqus deck begins with a keyword such as *HEADING or *NODE");
  return input;
}

bool Fields::next(std::string_view& field) {
  if (rest_.empty()) return false;
  const std::size_t comma = rest_.find(',');
  field = trim(rest_.substr(0, comma));
  if (comma == std::string_view::npos) {
    rest_ = {};
    return !field.empty();
  }
  rest_ = rest_.substr(comma + 1);
  return true;
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  Fields reader(line);
  for (std::string_view field; reader.next(field);) fields.push_back(field);
  return fields;
}

std::optional<double> to_number(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  std::array<char, 64> buffer;
  if (field.empty() || field.size() > buffer.size()) return std::nullopt;
  std::transform(field.begin(), field.end(), buffer.begin(), [](char c) { return c == 'd' || c == 'D' ? 'e' : c; });
  double value = 0.0;
  const char* end = buffer.data() + field.size();
  const auto [stop, fault] = std::from_chars(buffer.data(), end, value);
  if (fault != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<long> to_integer(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  long value = 0;
  const auto [stop, fault] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (field.empty() || fault != std::errc() || stop != field.data() + field.size()) return std::nullopt;
  return value;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), to_lower);
  return result;
}

std::string upper_without_blanks(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (!is_blank(c)) result += to_upper(c);
  return result;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace tisserand::reducer::abaqus

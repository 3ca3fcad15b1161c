// SPDX-License-Identifier: GPL-3.0-or-later
// First step of a Nastran deck: cards of fields with line numbers, from the text of the file and its INCLUDEs.
#include "reducer/decks/nastran/cards.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "reducer/decks/nastran/fields.hpp"

namespace tisserand::reducer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_levels = 20;
constexpr std::size_t most_files = 2000;
constexpr std::uintmax_t most_bytes = std::uintmax_t{4} << 30;
constexpr std::size_t columns = 80;
constexpr long most_repeated = 100000;  ///< cards of one replication

char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

bool starts_with_word(std::string_view line, std::string_view word) {
  return line.size() >= word.size() && same_word(line.substr(0, word.size()), word);
}

/// One physical line as fields.
struct Line {
  std::string_view name;  ///< trimmed; with the sign + or * of a continuation
  std::array<std::string_view, 8> fields;
  int count = 0;  ///< four or eight
  bool continuation = false;
  std::string_view mark;  ///< continuation mark for the next line, without its first character
};

class CardReader {
 public:
  CardReader(NastranCards& cards, DeckFaults& faults) : cards_(cards), faults_(faults) {}

  void read_file(const std::string& path, const std::string& from);

 private:
  std::string_view load(const std::string& path, const std::string& from);
  void read_lines(std::string_view text, std::size_t start_line);
  void read_line(std::string_view raw);
  void include(std::string_view rest);
  std::string_view expand_tabs(std::string_view line);
  bool split(std::string_view line, Line& out);
  bool split_free(std::string_view line, Line& out);
  void split_fixed(std::string_view line, Line& out);
  void append(const Line& line);
  void read_case_control(std::string_view text);
  bool replicate(const Line& line);
  void repeat(const std::array<std::string_view, 8>& pattern);
  std::string_view keep(std::string text);
  std::string here() const { return fmt::format("{}:{}", cards_.files[file_], line_); }

  NastranCards& cards_;
  DeckFaults& faults_;
  std::vector<fs::path> open_;  ///< open files, outermost first
  std::uintmax_t bytes_ = 0;
  std::uint32_t file_ = 0;
  std::uint32_t line_ = 0;
  std::string_view text_;                      ///< of the current file from the next line on
  std::size_t position_ = 0;                   ///< fields of the last card with blank ones
  bool has_card_ = false;                      ///< a continuation may follow
  std::string_view mark_;                      ///< of the last line
  std::array<std::string_view, 8> pattern_{};  ///< of the last replication
  bool ended_ = false;
};

/// Text of `path`. Only regular files are read: a pipe or device may have no end.
std::string_view CardReader::load(const std::string& path, const std::string& from) {
  std::error_code code;
  if (!fs::exists(path, code)) throw Error(fmt::format("{} does not exist", path), from, "check the path of the deck");
  if (!fs::is_regular_file(path, code)) throw Error(fmt::format("{} is not a file", path), from, "name a text file");
  const std::uintmax_t size = fs::file_size(path, code);
  bytes_ += code ? 0 : size;
  if (code || bytes_ > most_bytes)
    throw Error(fmt::format("{}: the deck has more than 4 GiB of text", path), from,
                "divide the part into several parts");
  auto text = std::make_unique<std::string>(static_cast<std::size_t>(size), '\0');
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(text->data(), static_cast<std::streamsize>(size)) && size > 0)
    throw Error(fmt::format("{} cannot be read", path), from, "check its permissions");
  cards_.texts.push_back(std::move(text));
  return *cards_.texts.back();
}

/// Begin of the bulk data: after the line BEGIN BULK, or the start without it. `line` is the number of lines before.
std::size_t bulk_start(std::string_view text, std::size_t& line) {
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view words = trimmed(text.substr(at, end - at));
    if (!words.empty() && capital(words[0]) == 'B' && starts_with_word(words, "BEGIN") &&
        capitals(words.substr(5, 20)).find("BULK") != std::string::npos) {
      line = number + 1;
      return std::min(end + 1, text.size());
    }
    at = end + 1;
  }
  line = 0;
  return 0;
}

void CardReader::read_file(const std::string& path, const std::string& from) {
  std::error_code code;
  const fs::path real = fs::weakly_canonical(path, code);
  if (std::find(open_.begin(), open_.end(), real) != open_.end())
    throw Error(fmt::format("INCLUDE of {}: this file includes itself", path), from, "remove this INCLUDE");
  if (open_.size() >= most_levels || cards_.files.size() >= most_files)
    throw Error(fmt::format("INCLUDE of {}: more than {} levels or {} files", path, most_levels, most_files), from,
                "join some of the files");
  open_.push_back(real);
  const std::string_view text = load(path, from);
  const std::uint32_t outer_file = file_, outer_line = line_;
  const std::string_view outer_text = text_;
  cards_.files.push_back(path);
  file_ = static_cast<std::uint32_t>(cards_.files.size() - 1);
  std::size_t first_line = 0;
  const std::size_t start = bulk_start(text, first_line);
  if (open_.size() == 1) cards_.complete = first_line == 0;
  read_lines(text.substr(start), first_line);
  if (open_.size() == 1) read_case_control(text.substr(0, start));  // after the bulk data, which it overrides
  file_ = outer_file;
  line_ = outer_line;
  text_ = outer_text;
  open_.pop_back();
}

void CardReader::read_lines(std::string_view text, std::size_t start_line) {
  text_ = text;
  line_ = static_cast<std::uint32_t>(start_line);
  while (!text_.empty() && !ended_) {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    const std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++line_;
    read_line(line);
  }
}

void CardReader::read_line(std::string_view raw) {
  std::string_view line = raw.substr(0, std::min(raw.find('$'), raw.size()));
  while (!line.empty() && (line.back() == ' ' || line.back() == '\r' || line.back() == '\t')) line.remove_suffix(1);
  if (line.empty()) return;
  if (const std::string_view words = trimmed(line); words.size() > 7 && starts_with_word(words, "INCLUDE") &&
                                                    std::string_view(" '\"\t").find(words[7]) != std::string_view::npos)
    return include(trimmed(raw).substr(7));
  if (starts_with_word(trimmed(line), "ENDDATA")) {
    ended_ = cards_.complete = true;
    return;
  }
  Line fields;
  if (line.find('\t') != std::string_view::npos && line.find(',') == std::string_view::npos) line = expand_tabs(line);
  if (split(line, fields)) append(fields);
}

/// Reads INCLUDE 'path': quotes may span lines; the path is relative to the folder of the including file.
void CardReader::include(std::string_view rest) {
  const std::string from = here();
  std::string name(trimmed(rest));
  if (!name.empty() && (name[0] == '\'' || name[0] == '"')) {
    const char quote = name[0];
    for (int lines = 0; name.find(quote, 1) == std::string::npos && !text_.empty() && lines < 20; ++lines) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      name += trimmed(text_.substr(0, end));
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++line_;
    }
    const std::size_t close = name.find(quote, 1);
    if (close == std::string::npos)
      return faults_.add("INCLUDE: the closing quote is missing", from, "close the quote");
    name = name.substr(1, close - 1);
  } else {
    name = name.substr(0, name.find('$'));
    name = std::string(trimmed(name));
  }
  if (name.empty() || name.find('\0') != std::string::npos)
    return faults_.add("INCLUDE without the name of a file", from, "give the name of a file");
  has_card_ = false;
  const auto place = [this](const fs::path& path) {
    return path.is_absolute() ? path : fs::path(cards_.files[file_]).parent_path() / path;
  };
  std::error_code code;
  if (!fs::exists(place(name), code)) std::replace(name.begin(), name.end(), '\\', '/');  // path of another system
  read_file(place(name).string(), from);
  has_card_ = false;
}

/// Line with tabs replaced by blanks up to the next multiple of eight columns.
std::string_view CardReader::expand_tabs(std::string_view line) {
  auto text = std::make_unique<std::string>();
  for (const char c : line) {
    if (text->size() > columns) break;
    if (c == '\t')
      text->append(8 - text->size() % 8, ' ');
    else
      text->push_back(c);
  }
  cards_.texts.push_back(std::move(text));
  return *cards_.texts.back();
}

/// Splits a line into fields. False for an empty line, or after a fault.
bool CardReader::split(std::string_view line, Line& out) {
  if (line.find(',') != std::string_view::npos) {
    if (!split_free(line, out)) return false;
  } else {
    split_fixed(line, out);
  }
  out.continuation = out.name.empty() || out.name[0] == '+' || out.name[0] == '*';
  return true;
}

bool CardReader::split_free(std::string_view line, Line& out) {
  std::array<std::string_view, 10> part;
  std::size_t count = 0;
  for (std::string_view rest = line;;) {
    const std::size_t comma = rest.find(',');
    const std::string_view field = trimmed(rest.substr(0, comma));
    if (count < part.size())
      part[count] = field;
    else if (!field.empty()) {
      faults_.add(fmt::format("the free-field line has more than {} fields", part.size()), here(),
                  "continue on the next line");
      return false;
    }
    ++count;
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  out.name = part[0];
  out.count = !out.name.empty() && (out.name[0] == '*' || out.name.back() == '*') ? 4 : 8;
  const auto last = static_cast<std::size_t>(out.count) + 1;
  for (std::size_t i = 1; i < last; ++i) out.fields[i - 1] = part[i];
  std::string_view mark = part[last];
  const std::size_t tail = std::min(count, last) - 1;  // a lone + or * ends the line at any place
  if (tail >= 1 && tail < last && (part[tail] == "+" || part[tail] == "*")) {
    mark = part[tail];
    out.fields[tail - 1] = {};
  }
  if (!mark.empty() && mark.find_first_of("0123456789.-") == 0) {
    faults_.add(fmt::format("'{}' is in the field of the continuation mark", mark), here(),
                "continue on the next line");
    return false;
  }
  if (!mark.empty()) out.mark = mark.substr(1);
  return true;
}

void CardReader::split_fixed(std::string_view line, Line& out) {
  const auto cut = [&](std::size_t start, std::size_t width) {
    return start < line.size() ? trimmed(line.substr(start, width)) : std::string_view();
  };
  out.name = cut(0, 8);
  const bool large = !out.name.empty() && (out.name[0] == '*' || out.name.back() == '*');
  const std::size_t width = large ? 16 : 8;
  out.count = large ? 4 : 8;
  for (std::size_t i = 0; i < static_cast<std::size_t>(out.count); ++i) {
    const std::size_t start = 8 + i * width;
    if (start >= line.size()) break;
    out.fields[i] = cut(start, width);
  }
  const std::string_view mark = cut(72, 8);
  if (!mark.empty()) out.mark = mark.substr(1);
}

std::string_view CardReader::keep(std::string text) {
  cards_.texts.push_back(std::make_unique<std::string>(std::move(text)));
  return *cards_.texts.back();
}

/// Sum of `value` and `step` as numbers of the deck; empty if one is no number.
std::optional<std::string> incremented(std::string_view value, std::string_view step) {
  if (const auto a = parse_integer(value), b = parse_integer(step); a && b) return std::to_string(*a + *b);
  const auto a = parse_real(value), b = parse_real(step);
  if (!a || !b) return std::nullopt;
  std::string text = fmt::format("{}", *a + *b);
  if (text.find_first_of(".e") == std::string::npos) text += '.';
  return text;
}

/// Adds a card like the last: = keeps its field, == also the following fields, *x and *(x) add x to it.
void CardReader::repeat(const std::array<std::string_view, 8>& pattern) {
  const NastranCard last = cards_.cards.back();
  Line line;
  line.name = last.name;
  line.count = 8;
  bool rest = false;
  for (int i = 0; i < std::ssize(pattern); ++i) {
    std::string_view field = pattern[i];
    const std::string_view before = cards_.field(last, i);
    rest = rest || field == "==";
    if (rest || field == "=") {
      line.fields[i] = before;
    } else if (!field.empty() && field[0] == '*') {
      field.remove_prefix(1);
      if (field.size() > 2 && field.front() == '(' && field.back() == ')') field = field.substr(1, field.size() - 2);
      const std::optional<std::string> sum = incremented(before, field);
      if (!sum)
        return faults_.add(fmt::format("replication: '{}' cannot be added to '{}'", field, before), here(),
                           "give a number");
      line.fields[i] = keep(*sum);
    } else {
      line.fields[i] = field;
    }
  }
  append(line);
}

/// Handles lines that begin with =: the last card with changes, or =n and =(n), the last of these n times. False:
/// another line.
bool CardReader::replicate(const Line& line) {
  if (line.name.empty() || line.name[0] != '=') return false;
  if (!has_card_ || cards_.cards.back().count > 8) {
    faults_.add(fmt::format("replication '{}' does not follow a card of one line", line.name), here(),
                "write the cards in full");
    return true;
  }
  std::string_view count = line.name.substr(1);
  if (count.empty() || count == "=") {
    pattern_ = line.fields;
    if (!count.empty()) pattern_.fill("=");
    repeat(pattern_);
    return true;
  }
  if (count.size() > 2 && count.front() == '(' && count.back() == ')') count = count.substr(1, count.size() - 2);
  const std::optional<long> times = parse_integer(count);
  if (!times || *times < 1 || *times > most_repeated)
    faults_.add(fmt::format("replication '{}' is not understood", line.name), here(),
                fmt::format("write the number of repetitions as =N, with N from 1 to {}", most_repeated));
  else
    for (long k = 0; k < *times; ++k) repeat(pattern_);
  return true;
}

/// Reads case control: PARAM counts as in the bulk data; SPC and MPC select sets, in any subcase.
void CardReader::read_case_control(std::string_view text) {
  line_ = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view raw = text.substr(0, end),
                           line = trimmed(raw.substr(0, std::min(raw.find('$'), raw.size())));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line_;
    if (line.empty() || starts_with_word(line, "BEGIN")) continue;
    cards_.has_case_control = cards_.has_case_control || same_word(line, "CEND");
    if (starts_with_word(line, "PARAM")) {
      Line fields;
      if (split(line, fields) && !fields.continuation) append(fields);
      has_card_ = false;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string word = capitals(trimmed(line.substr(0, equals)));
    if (word != "SPC" && word != "MPC") continue;
    cards_.selected[word].insert(std::string(trimmed(line.substr(equals + 1))));
    cards_.has_case_control = true;
  }
}

void CardReader::append(const Line& line) {
  if (replicate(line)) return;
  if (line.continuation) {
    const std::string_view mark = line.name.empty() ? line.name : line.name.substr(1);
    if (!has_card_)
      return faults_.add(fmt::format("continuation '{}' without a card before it", line.name), here(),
                         "put it after the card that it continues");
    if (!mark.empty() && !mark_.empty() && mark != mark_)
      faults_.add(fmt::format("continuation '{}' follows a line with the mark '+{}'", line.name, mark_), here(),
                  "put it after the card that it continues");
    const auto step = static_cast<std::size_t>(line.count);
    position_ = (position_ + step - 1) / step * step;
  } else {
    NastranCard card;
    card.name = line.name;
    if (card.name.back() == '*') card.name = trimmed(card.name.substr(0, card.name.size() - 1));
    card.first = cards_.fields.size();
    card.line = line_;
    card.file = file_;
    cards_.cards.push_back(card);
    position_ = 0;
    has_card_ = true;
  }
  NastranCard& card = cards_.cards.back();
  for (std::size_t i = 0; i < static_cast<std::size_t>(line.count); ++i) {
    if (line.fields[i].empty()) continue;
    cards_.fields.resize(card.first + position_ + i);
    cards_.fields.push_back(line.fields[i]);
    card.count = static_cast<std::uint32_t>(cards_.fields.size() - card.first);
  }
  position_ += static_cast<std::size_t>(line.count);
  mark_ = line.mark;
}

}  // namespace

std::string NastranCards::where(const NastranCard& card) const {
  return fmt::format("{}:{}", files[card.file], card.line);
}

NastranCards read_nastran_cards(const std::string& path, DeckFaults& faults) {
  NastranCards cards;
  CardReader(cards, faults).read_file(path, "");
  return cards;
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string capitals(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), capital);
  return result;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return capital(x) == capital(y); });
}

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Text of foreign files by lines and fields, with places for messages, independent of the format.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand::reducer::exchange {

/// Lines of a file. Throws Error if it cannot be read, is no regular file, or has more than 2 GiB.
class TextLines {
 public:
  explicit TextLines(const std::string& path);

  /// Reads the next line without its end; returns false at the end of the file.
  bool next(std::string_view& line);
  std::size_t number() const { return number_; }  ///< number of the last line, from 1
  std::string where() const;                      ///< "path:number"
  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }

 private:
  std::string path_;
  std::string text_;
  std::size_t at_ = 0;
  std::size_t number_ = 0;
};

/// Non-empty fields between blanks, tabs, commas and semicolons.
std::vector<std::string_view> words_of(std::string_view line);

/// Fields between commas without surrounding blanks; some may be empty.
std::vector<std::string_view> cells_of(std::string_view line);

/// A finite number, also with Fortran's exponents. `what` names it in the Error.
double number_of(std::string_view field, std::string_view what, const TextLines& lines);

/// A whole number. `what` names it in the Error.
long integer_of(std::string_view field, std::string_view what, const TextLines& lines);

/// Text in upper case without blanks at both ends, at most `length` characters, to recognise a file.
std::string start_of(std::string_view text, std::size_t length);

/// Whether a line of the text begins with `word`; case and leading blanks are ignored.
bool has_line(std::string_view text, std::string_view word);

/// Short printable text for messages.
std::string shown(std::string_view text);

}  // namespace tisserand::reducer::exchange

// SPDX-License-Identifier: GPL-3.0-or-later
// Text of foreign files by lines and fields, with places for messages, independent of the format.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand::reducer::exchange {

/// Reader of the lines of a text file. Throws Error if the file cannot be read, is no regular file, or has more than 2
/// GiB.
class TextLines {
 public:
  explicit TextLines(const std::string& path);

  /// Reads the next line without its end; returns false at the end of the file.
  bool next(std::string_view& line);
  std::size_t number() const { return number_; }  ///< number of the line that was read last, from 1
  std::string where() const;                      ///< place of the line that was read last: "path:number"
  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }

 private:
  std::string path_;
  std::string text_;
  std::size_t at_ = 0;
  std::size_t number_ = 0;
};

/// Non-empty fields of a line between blanks, tabs, commas and semicolons.
std::vector<std::string_view> words_of(std::string_view line);

/// Fields of a line between commas, without surrounding blanks. Some may be empty.
std::vector<std::string_view> cells_of(std::string_view line);

/// Finite number that the field holds, also with Fortran's exponent. Throws Error otherwise. `what`: name of the
/// quantity for the message.
double number_of(std::string_view field, std::string_view what, const TextLines& lines);

/// Whole number that the field holds. Throws Error otherwise. `what`: name of the quantity for the message.
long integer_of(std::string_view field, std::string_view what, const TextLines& lines);

/// Beginning of a text, by which a file is recognised: in upper case, without blanks at both ends, at most `length`
/// characters.
std::string start_of(std::string_view text, std::size_t length);

/// Whether a line of the text begins with `word`, apart from upper and lower case and leading blanks.
bool has_line(std::string_view text, std::string_view word);

/// Short printable form of a text for messages.
std::string shown(std::string_view text);

}  // namespace tisserand::reducer::exchange

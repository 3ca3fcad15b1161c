// SPDX-License-Identifier: GPL-3.0-or-later
// First step of read_abaqus(): blocks of one keyword each from the text of a deck and its included files.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand::reducer::abaqus {

/// Data line of a deck. Its text is a part of Input::texts.
struct Line {
  std::string_view text;
  std::uint32_t file = 0;  ///< index in Input::paths
  std::uint32_t number = 0;
};

/// Parameter of a keyword line, such as {"REFNODE", "7"} for REF NODE=7.
struct Parameter {
  std::string name;   ///< upper case without blanks
  std::string value;  ///< as written, without quotes and surrounding blanks
};

/// Keyword line with its parameters, and the data lines up to the next keyword line.
struct Block {
  std::string keyword;  ///< keyword in upper case without blanks: "SHELLSECTION"
  std::string title;    ///< keyword as shown in messages: "*SHELL SECTION"
  std::vector<Parameter> parameters;
  std::vector<Line> data;
  std::uint32_t file = 0;
  std::uint32_t line = 0;

  /// Value of a parameter ("" if it has none); null if the parameter is absent.
  const std::string* find(std::string_view name) const;
  /// Value of a parameter in lower case, for names of sets, materials and parts; "" if the parameter is absent.
  std::string name_of(std::string_view parameter) const;
  /// Value of a parameter in upper case without blanks, for parameters with a fixed set of words. Returns `if_absent`
  /// if the parameter is absent.
  std::string word_of(std::string_view parameter, std::string_view if_absent) const;
};

/// Text of a deck with all included files, divided into keyword blocks.
struct Input {
  std::vector<std::string> paths;
  std::vector<std::unique_ptr<std::string>> texts;
  std::vector<Block> blocks;

  std::string where(const Block& block) const;
  std::string where(const Line& line) const;
};

/// Reads the blocks of a deck, with the files of *INCLUDE and of INPUT= parameters. Their paths are relative to the
/// file that names them. ** comments and blank lines are dropped. A keyword line that ends with a comma continues in
/// the next line. Throws Error for files that cannot be read and for texts that are no deck.
Input read_input(const std::string& path);

/// Sequence of the fields of a data line between commas, without surrounding blanks. A comma at the end of the line
/// begins no further field.
class Fields {
 public:
  explicit Fields(std::string_view line) : rest_(line) {}
  /// Sets `field` to the next field. Returns false at the end of the line.
  bool next(std::string_view& field);

 private:
  std::string_view rest_;
};

std::vector<std::string_view> split(std::string_view line);

/// Decimal number that the field holds, also with Fortran's exponent ("1.5D+3"). Returns nothing for text, infinities
/// and NaN.
std::optional<double> to_number(std::string_view field);
std::optional<long> to_integer(std::string_view field);

std::string lower(std::string_view text);
std::string upper_without_blanks(std::string_view text);
std::string_view trim(std::string_view text);

}  // namespace tisserand::reducer::abaqus

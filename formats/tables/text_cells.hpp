// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of text tables split into cells, for the readers of tables.
#pragma once

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand::formats {

/// Opens the text file of a table. Throws Error: no such file, not a regular file (with the given `remedy`), no
/// permission, UTF-16.
std::ifstream open_table(const std::string& path, const std::string& remedy);

/// The text without blanks, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// Separator of a line: the first of comma, semicolon and tab, in this order, that it contains; otherwise a blank.
char separator_of(std::string_view line);

/// Cells of a line between separators. Consecutive blanks are one separator; each other separator counts.
std::vector<std::string_view> split_cells(std::string_view line, char separator);

/// Whether the text is a finite number. If so, stores it in `value`.
bool read_finite(std::string_view text, double& value);

// Messages do not quote files that are no tables: a scene from elsewhere may name any file that the user can read.
/// Description of a cell that is not a number, for messages. The cell is quoted if it resembles a number ("1.2.3",
/// "1,6", "nan") or if earlier lines had numbers (`in_table`). Otherwise the description is "a text of 31 characters".
std::string quoted_cell(std::string_view cell, bool in_table);

/// Whether a line begins with a number and has `count` cells, of which at least half are numbers. If so, the line
/// before it holds names of columns.
bool is_row_of_numbers(std::string_view line, char separator, std::size_t count);

}  // namespace tisserand::formats

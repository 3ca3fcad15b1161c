// Lines of text tables as cells, for the readers of tables.
#pragma once

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand::formats {

/// The open file. Throws Error: no such file, none that is regular, no permission, UTF-16.
std::ifstream open_table(const std::string& path, const std::string& remedy);

/// Without blanks, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// The first of comma, semicolon and tab that the line has; otherwise a blank.
char separator_of(std::string_view line);

/// Cells between separators; blanks separate together, all others one by one.
std::vector<std::string_view> split_cells(std::string_view line, char separator);

/// Whether the text is a finite number, which is then the value.
bool read_finite(std::string_view text, double& value);

// Messages quote nothing of a file that is no table: a scene from elsewhere may name any file that its reader may read.
/// A cell that is no number: in quotes where it looks like a number with a slip ("1.2.3", "1,6", "nan") or where lines
/// before it held numbers (`in_table`); otherwise "a text of 31 characters".
std::string quoted_cell(std::string_view cell, bool in_table);

/// Whether a line begins with a number and has `count` cells of which half are numbers: then the line before it names
/// columns.
bool is_row_of_numbers(std::string_view line, char separator, std::size_t count);

}  // namespace tisserand::formats

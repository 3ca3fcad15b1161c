// Lines of text tables as cells, for the readers of tables.
#pragma once

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand::formats {

/// The open file. Throws Error: no such file, none that is regular, no permission.
std::ifstream open_table(const std::string& path, const std::string& remedy);

/// Without blanks, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// The first of comma, semicolon and tab that the line has; otherwise a blank.
char separator_of(std::string_view line);

/// Cells between separators; blanks separate together, all others one by one.
std::vector<std::string_view> split_cells(std::string_view line, char separator);

/// Whether the text is a finite number, which is then the value.
bool read_finite(std::string_view text, double& value);

}  // namespace tisserand::formats

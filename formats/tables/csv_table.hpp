// A function of time from a text table of two columns.
#pragma once

#include <string>

#include "formats/tables/time_table.hpp"

namespace tisserand::formats {

/// Two numbers per line (time, value) with comma, semicolon or blanks between them; lines that begin with # and empty
/// lines are skipped, and so is a first line of words. Throws Error with path:line:column.
TimeTable read_csv_table(const std::string& path);

}  // namespace tisserand::formats

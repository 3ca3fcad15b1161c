// SPDX-License-Identifier: GPL-3.0-or-later
// Function of time from a text table of two columns.
#pragma once

#include <string>

#include "formats/tables/time_table.hpp"

namespace tisserand::formats {

/// Reads two numbers per line (time, value), separated by comma, semicolon or blanks. Skips lines that begin with #,
/// empty lines and a first line of words. Throws Error with path:line:column.
TimeTable read_csv_table(const std::string& path);

}  // namespace tisserand::formats

// SPDX-License-Identifier: GPL-3.0-or-later
// Function of time from a text table of two columns.
#pragma once

#include <string>

#include "formats/tables/time_table.hpp"

namespace tisserand::formats {

/// Reads a table of time and value from a text file. Each line holds two numbers, separated by comma, semicolon or
/// blanks. Empty lines, lines that begin with # and a first line of words are skipped. Throws Error with
/// path:line:column.
TimeTable read_csv_table(const std::string& path);

}  // namespace tisserand::formats

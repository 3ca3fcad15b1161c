// SPDX-License-Identifier: GPL-3.0-or-later
// History over time from two columns of a text table or two datasets of an HDF5 file.
#pragma once

#include <string>

#include "formats/tables/time_table.hpp"

namespace tisserand::formats {

/// Location of a time history: a file, and the names of its columns of times and values. Text: columns by name in the
/// first line that is no comment, or by number from 1. Cells are separated by the first of comma, semicolon and tab
/// that the line has, else by blanks. HDF5: paths of one-dimensional datasets of 64-bit floats.
struct InputPlace {
  std::string file;
  std::string time;
  std::string value;
};

/// Reads a time history. Throws Error: no such file or column, cells that are no finite numbers, columns of different
/// lengths, more than ten million points. HDF5 files are recognised by their first bytes.
TimeTable read_input_table(const InputPlace& place);

}  // namespace tisserand::formats

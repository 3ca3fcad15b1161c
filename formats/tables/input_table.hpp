// A history over time from two columns of a text table or two datasets of an HDF5 file.
#pragma once

#include <string>

#include "formats/tables/time_table.hpp"

namespace tisserand::formats {

/// Where a history stands. Text: columns by the name in the first line that is no comment, or by number from 1 (cells
/// separated by commas, semicolons, tabs or blanks: the first of these that the line has). HDF5: paths of
/// one-dimensional datasets of 64-bit floats.
struct InputPlace {
  std::string file;
  std::string time;
  std::string value;
};

/// Throws Error: no such file or column, cells that are no finite numbers, lengths that differ, more than ten million
/// points. The file is recognised as HDF5 by its first bytes.
TimeTable read_input_table(const InputPlace& place);

}  // namespace tisserand::formats

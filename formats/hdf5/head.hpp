// What the head of every binary file of ours says: its format, its version and its units.
#pragma once

#include <string>

#include "common/units.hpp"
#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

/// One kind of file, in the words of messages.
struct FileKind {
  const char* format;         ///< value of the attribute 'format'
  const char* noun;           ///< "superelement file"
  const char* source;         ///< remedy for a file of another kind
  const char* other_version;  ///< remedy for another major version than 1
};

/// Throws Error unless attributes 'format' and 'version' (1.x) are those of `kind`.
void check_format(const InputFile& file, const FileKind& kind);

/// y of the version 1.y of a file that check_format() accepts.
int minor_version(const InputFile& file);

/// Attributes length_unit, mass_unit, time_unit and their labels.
Units read_units(const InputFile& file);
void write_units(const Output& out, const Units& units);

/// Factors are positive or all zero, and agree with labels that are known. `where`: the file, or empty.
void check_units(const Units& units, const std::string& where);

}  // namespace tisserand::formats::hdf5

// SPDX-License-Identifier: GPL-3.0-or-later
// The head of every binary file of this project: format, version and units.
#pragma once

#include <string>

#include "common/units.hpp"
#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

/// Kind of HDF5 file of the project, with the texts that messages about such a file use.
struct FileKind {
  const char* format;         ///< value of the attribute 'format'
  const char* noun;           ///< "superelement file"
  const char* source;         ///< remedy for a file of another kind
  const char* other_version;  ///< remedy for a major version other than 1
};

/// Checks that the attributes 'format' and 'version' (1.x) of a file match `kind`. Throws Error otherwise.
void check_format(const InputFile& file, const FileKind& kind);

/// Minor version y of the version 1.y of a file that check_format() accepts.
int minor_version(const InputFile& file);

/// Units of a file from the attributes length_unit, mass_unit, time_unit and their labels.
Units read_units(const InputFile& file);
void write_units(const Output& out, const Units& units);

/// Checks that factors of units are positive or all zero and agree with known labels. `where`: name of the file in
/// messages, or empty. Throws Error otherwise.
void check_units(const Units& units, const std::string& where);

}  // namespace tisserand::formats::hdf5

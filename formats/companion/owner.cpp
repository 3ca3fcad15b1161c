// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the attributes that identify a companion file.
#include "formats/companion/owner.hpp"

#include "common/error.hpp"
#include "formats/hdf5/head.hpp"

namespace tisserand::formats {
namespace {

constexpr hdf5::FileKind companion_head{"tisserand-companion", "companion file", "give a *.companion.h5 file",
                                        "reduce the part again with a program of the same major version"};

CompanionOwner read_owner(const std::string& path) {
  const hdf5::InputFile file(path, hdf5::Completeness::closed);
  hdf5::check_format(file, companion_head);
  return {file.text_attribute("/", "producer"), file.text_attribute("/", "superelement")};
}

}  // namespace

std::optional<CompanionOwner> companion_owner(const std::string& path) {
  try {
    return read_owner(path);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace tisserand::formats

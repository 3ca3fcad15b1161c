// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing of what lies over HDF5: valid containers whose objects, types, shapes, layouts and values come from bytes.
#pragma once

#include <cstdint>
#include <string>

namespace tisserand::test_support {

/// Image of a copy of the HDF5 file at `sound`, in which each attribute and then each object, in the order of their
/// names, takes one byte as the choice of what is done to it (0: nothing) and further bytes for the details. No bytes
/// at all: the sound file, without its content_id (a changed file would be refused for that alone). Throws Error if
/// `sound` cannot be opened.
std::string mutated_container(const std::string& sound, const std::uint8_t* data, std::size_t size);

}  // namespace tisserand::test_support

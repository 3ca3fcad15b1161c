// Fuzzing of what lies over HDF5: valid containers whose objects, types, shapes, layouts and values come from bytes.
#pragma once

#include <cstdint>
#include <string>

namespace tisserand::test_support {

/// Image of an HDF5 file: the superelement of a beam, in which each attribute and each dataset of
/// formats/SUPERELEMENT.md takes one byte as the choice of what is done to it (0: nothing) and further bytes for the
/// details. No bytes at all: a sound superelement.
std::string superelement_container(const std::uint8_t* data, std::size_t size);

}  // namespace tisserand::test_support

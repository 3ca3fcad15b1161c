// HDF5 over a file that is open already, where nothing can be opened any more.
#pragma once

#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

/// Properties of a file access that reads from `descriptor`, of so many bytes, whatever name H5Fopen() is given. Files
/// may also be opened for reading and writing: what HDF5 then writes stays in memory.
Handle access_through(int descriptor, std::uint64_t size);

}  // namespace tisserand::formats::hdf5

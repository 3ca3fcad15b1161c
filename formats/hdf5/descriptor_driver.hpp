// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 access to a file that is already open, for a sandbox in which no file can be opened.
#pragma once

#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

/// Access properties for H5Fopen() with which HDF5 reads `size` bytes from `descriptor`, whatever file name it gets. If
/// the file is opened for writing too, what HDF5 writes stays in memory.
Handle access_through(int descriptor, std::uint64_t size);

}  // namespace tisserand::formats::hdf5

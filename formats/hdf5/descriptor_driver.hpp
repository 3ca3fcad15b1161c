// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 access to a file that is already open, for a sandbox in which no file can be opened.
#pragma once

#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

/// Access properties that read `size` bytes from `descriptor`, whatever name H5Fopen() gets. If the file is opened for
/// writing too, what HDF5 writes stays in memory.
Handle access_through(int descriptor, std::uint64_t size);

}  // namespace tisserand::formats::hdf5

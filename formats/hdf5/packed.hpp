// SPDX-License-Identifier: GPL-3.0-or-later
// Large arrays of 32-bit numbers in files on disk: chunked, compressed, with checksums, read and written by rows.
#pragma once

#include <string>

#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

/// HDF5 file that is written under a temporary name until publish() renames it. Without publish() nothing is left.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  Output output() const { return {file_.id(), path_, Packing::fast}; }
  const std::string& path() const { return path_; }
  /// Closes the complete file and returns its temporary name. Requires that the caller renames or removes it.
  std::string stage();
  void publish();

 private:
  std::string path_, temporary_;
  Handle file_;
};

/// Creates a dataset of 32-bit floats with `chunk` rows per chunk.
Handle create_packed(const Output& out, const std::string& dataset, const Shape& shape, std::uint64_t chunk);
/// Writes rows [first, first + count) of a dataset made by create_packed().
void write_packed_rows(const Handle& dataset, std::uint64_t first, std::uint64_t count, const float* values,
                       const std::string& where);

/// Closes a dataset made by create_packed(), which writes its last values to the disk. Throws Error if that fails.
void close_packed(Handle& handle, const std::string& dataset, const std::string& where);

}  // namespace tisserand::formats::hdf5

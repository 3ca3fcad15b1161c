// Large arrays of 32-bit numbers in files on the disk: chunked, compressed, with checksums, read and written by rows.
#pragma once

#include <string>

#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

/// A file that grows beside its name and takes it in publish(); without that, nothing is left.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  Output output() const { return {file_.id(), path_, Packing::fast}; }
  const std::string& path() const { return path_; }
  /// Closes the complete file under its temporary name, which is returned; the caller renames or removes it.
  std::string stage();
  void publish();

 private:
  std::string path_, temporary_;
  Handle file_;
};

/// A dataset of 32-bit floats whose chunks hold `chunk` rows each.
Handle create_packed(const Output& out, const std::string& dataset, const Shape& shape, std::uint64_t chunk);
/// Rows [first, first + count) of it.
void write_packed_rows(const Handle& dataset, std::uint64_t first, std::uint64_t count, const float* values,
                       const std::string& where);

/// Closes the dataset, whose last values go to the disk only now. Throws Error if they do not.
void close_packed(Handle& handle, const std::string& dataset, const std::string& where);

}  // namespace tisserand::formats::hdf5

// SPDX-License-Identifier: GPL-3.0-or-later
// A file as HDF5 reads it. A damaged or crafted file can exploit HDF5 1.10, so only the process of apart.hpp uses this.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "formats/hdf5/entry.hpp"
#include "formats/hdf5/file.hpp"
#include "formats/hdf5/variable_texts.hpp"

namespace tisserand::formats::hdf5 {

/// Regular file opened for reading, before any of its bytes are read. The constructor throws Error: no such file, no
/// permission, a folder, no bytes.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }
  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// HDF5 file opened in the reading process, which reads and describes its objects.
class Container {
 public:
  /// Opens the HDF5 file. Requires that `file` outlives this object. Throws Error: not HDF5, cut short, not closed
  /// properly.
  Container(const OpenFile& file, Completeness completeness);

  const std::string& path() const { return path_; }
  bool closed_properly() const { return closed_properly_; }
  ObjectEntry describe(const std::string& object) const;
  /// Whether a dataset cannot grow and has at most `bytes` bytes. Texts of variable length count with the bytes of
  /// their references.
  bool is_fixed_and_below(const std::string& dataset, std::uint64_t bytes) const;
  // Both throw Error, also if the number of values differs from the expected one.
  std::vector<std::string> read_texts(const std::string& dataset, std::uint64_t count) const;
  void read(const ValuesRequest& request, const Place& place) const;

 private:
  std::string place(const std::string& object) const;
  /// Identifier of the open dataset `name`. The dataset stays open until another one is requested.
  Id dataset(const std::string& name) const;
  void describe_attributes(Id object, ObjectEntry& entry) const;
  AttributeEntry describe_attribute(Id object, const std::string& name) const;
  void read_text(Id attribute, Id type, AttributeEntry& entry) const;

  std::string path_;
  bool closed_properly_ = true;
  Handle file_;
  std::unique_ptr<VariableTexts> texts_;
  mutable std::string last_name_;
  mutable Handle last_;
};

}  // namespace tisserand::formats::hdf5

// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of HDF5 files. Every read is limited, typed and checked before memory is allocated. Every failure
// throws Error.
//
// All files are untrusted input: a sandboxed process reads them (apart.hpp). hdf5.h is included only in
// formats/hdf5/*.cpp; identifiers are HDF5's 64-bit hid_t.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "formats/hdf5/entry.hpp"

namespace tisserand::formats::hdf5 {

using Id = std::int64_t;

/// Owner of one HDF5 identifier.
class Handle {
 public:
  Handle() = default;
  Handle(Id id, int (*close)(Id)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { reset(); }

  Id id() const { return id_; }
  bool valid() const { return id_ >= 0; }
  /// Closes the identifier now. The result is negative if HDF5 failed (for a file: its last data may be missing).
  int reset();
  /// Releases the identifier without closing it, so that the file on disk stays as it is.
  void abandon() { id_ = -1; }

 private:
  Id id_ = -1;
  int (*close_)(Id) = nullptr;
};

/// Text of a shape: "12 x 3", or "scalar" if it is empty.
std::string shape_text(const Shape& shape);

/// Error for the HDF5 call that just failed: `action`, the reason of the operating system if there is one, the remedy.
Error last_error(const std::string& action, const std::string& where, const std::string& remedy);

class Apart;

/// HDF5 file opened for reading by a process that lives as long as this object. Object names are absolute paths; "/" is
/// the root group. Functions other than read...() return the state at the opening or at the first request.
class InputFile {
 public:
  /// Opens the file. Throws Error: no such file, no permission, a folder, not HDF5, cut short, not closed properly, or
  /// so damaged that HDF5 cannot read it.
  InputFile(const std::string& path, Completeness completeness);
  ~InputFile();

  const std::string& path() const { return path_; }
  bool closed_properly() const { return closed_properly_; }

  bool has(const std::string& object) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  /// Names of the links in a group (at most 10 000), sorted. Throws Error if there is no such group.
  std::vector<std::string> members(const std::string& group) const;
  std::vector<std::string> attributes(const std::string& object) const;

  // All of these also throw Error if HDF5 crashes or exceeds a limit, since it can loop forever. Limits are ten times
  // the processor time of an ordinary read, or much more than a slow disk needs.
  /// Value of an attribute that is one string (variable or fixed length, at most 1 MiB).
  std::string text_attribute(const std::string& object, const std::string& name) const;
  /// Value of an attribute that is one integer or floating-point number, as double.
  double number_attribute(const std::string& object, const std::string& name) const;

  /// Description of a dataset. Throws Error if it is missing, a group, a link, or stored outside of this file.
  DatasetInfo info(const std::string& dataset) const;

  // Each of these throws Error unless kind and shape agree with the request. `meaning` explains the shape in messages.
  void read(const std::string& dataset, const Shape& shape, const std::string& meaning, double* values) const;
  void read(const std::string& dataset, const Shape& shape, const std::string& meaning, std::int64_t* values) const;
  std::vector<std::string> read_texts(const std::string& dataset, std::uint64_t count,
                                      const std::string& meaning) const;
  /// Text of a scalar string dataset (at most 64 MiB).
  std::string read_text(const std::string& dataset) const;

  /// Reads rows [first, first + count) of a float64 dataset.
  void read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t count, double* values) const;
  /// Reads rows [first, first + count) of a float32 dataset.
  void read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t count, float* values) const;
  /// Reads column `column` (flat index within a row) of rows [0, count).
  void read_column(const std::string& dataset, std::uint64_t column, std::uint64_t count, double* values) const;

 private:
  std::string place(const std::string& object) const;
  const ObjectEntry& entry(const std::string& object) const;
  /// Entry of an object, or of the first link or broken object on its path. Null if there is no such object.
  const ObjectEntry* find(const std::string& object) const;
  const ObjectEntry& open(const std::string& object) const;
  const AttributeEntry& attribute(const std::string& object, const std::string& name, AttributeEntry::Kind kind,
                                  const char* meaning) const;
  void require(const std::string& dataset, ElementKind kind, const Shape& shape, const std::string& meaning) const;
  std::vector<std::string> texts(const std::string& dataset, std::uint64_t count) const;
  void values(const ValuesRequest& request, void* values) const;

  std::string path_;
  bool closed_properly_ = true;
  std::shared_ptr<Apart> apart_;
  std::size_t number_ = 0;  ///< index of this file in apart_
  mutable std::map<std::string, ObjectEntry> known_;
};

/// Storage of large arrays. none: uncompressed. small: shuffled and deflated (for many zeros). fast: like small, but in
/// larger pieces and in a third of the time.
enum class Packing { none, small, fast };

/// Destination of writes: the identifier of a file or group, the name of the file in messages, and the storage of large
/// arrays.
struct Output {
  Id id = -1;
  std::string where;
  Packing packing = Packing::none;
};

// Writing, used by the writers of superelements and results. Missing groups of a path are created. Texts are UTF-8. All
// throw Error.
/// Creates the groups on the path of a dataset, without time stamps, so that equal contents give equal bytes.
void create_groups(Id file, const std::string& dataset);
void write_attribute(const Output& out, const std::string& object, const std::string& name, const std::string& value);
void write_attribute(const Output& out, const std::string& object, const std::string& name, double value);
void write_attribute(const Output& out, const std::string& object, const std::string& name, std::int32_t value);
void write_dataset(const Output& out, const std::string& dataset, const Shape& shape, const double* values);
void write_dataset(const Output& out, const std::string& dataset, const Shape& shape, const std::int32_t* values);
/// Writes all values of a list or vector as a dataset of one dimension.
template <class List>
void write_dataset(const Output& out, const std::string& dataset, const List& values) {
  write_dataset(out, dataset, {static_cast<std::uint64_t>(values.size())}, values.data());
}
/// Writes texts as a dataset of fixed-length, zero-padded strings, of shape [values.size()]. The longest text sets the
/// length.
void write_texts(const Output& out, const std::string& dataset, const std::vector<std::string>& values);
/// Writes one scalar string dataset and replaces an existing one.
void write_text(const Output& out, const std::string& dataset, const std::string& value);

/// New HDF5 file in memory (core driver, nothing on disk). file_image() closes the file and returns its bytes.
Handle create_in_memory(const std::string& where);
std::string file_image(Handle file, const std::string& where);

/// Disables HDF5's own error messages and its work at the exit of the program. Every function that opens a file calls
/// it.
void silence();

}  // namespace tisserand::formats::hdf5

// Reading and writing of HDF5 files: every read is bounded, typed and checked before memory is taken, every failure is
// an Error.
//
// Files are untrusted input, whoever is said to have written them: a process that may only compute reads them
// (apart.hpp). Nothing of hdf5.h is seen outside formats/hdf5/*.cpp; identifiers are HDF5's 64-bit hid_t.
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
  /// Closes now; negative if HDF5 could not (for a file: its last data may be missing).
  int reset();
  /// Forgets the identifier without closing: what is on the disk stays as it is.
  void abandon() { id_ = -1; }

 private:
  Id id_ = -1;
  int (*close_)(Id) = nullptr;
};

/// "12 x 3"; "scalar" if empty.
std::string shape_text(const Shape& shape);

/// The Error of the HDF5 call that just failed: `action`, the reason of the operating system if there is one, the
/// remedy.
Error last_error(const std::string& action, const std::string& where, const std::string& remedy);

class Apart;

/// A file opened for reading, by a process that lives as long as this does. Object names are absolute paths; `object` =
/// "/" is the root group. Each function but read...() says what the file held when it was opened or first asked.
class InputFile {
 public:
  /// Throws Error: no such file, no permission, a folder, not HDF5, cut short, not closed properly, so damaged that
  /// HDF5 cannot read it.
  InputFile(const std::string& path, Completeness completeness);
  ~InputFile();

  const std::string& path() const { return path_; }
  bool closed_properly() const { return closed_properly_; }

  bool has(const std::string& object) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  /// Names of the links in a group (at most 10 000), sorted. Throws Error if there is no such group.
  std::vector<std::string> members(const std::string& group) const;
  std::vector<std::string> attributes(const std::string& object) const;

  // All of these throw Error, too, if HDF5 crashes, or needs ten times the processor time of an ordinary read (it can
  // loop for ever), or much more time by the clock than a slow disk.
  /// One string (variable or fixed length, at most 1 MiB).
  std::string text_attribute(const std::string& object, const std::string& name) const;
  /// One number, integer or floating, as double.
  double number_attribute(const std::string& object, const std::string& name) const;

  /// Throws Error if the dataset is missing, is a group, a link to elsewhere, or stored outside of this file.
  DatasetInfo info(const std::string& dataset) const;

  // Each of these throws Error unless kind and shape are as asked. `meaning` says in messages what the shape stands
  // for.
  void read(const std::string& dataset, const Shape& shape, const std::string& meaning, double* values) const;
  void read(const std::string& dataset, const Shape& shape, const std::string& meaning, std::int64_t* values) const;
  std::vector<std::string> read_texts(const std::string& dataset, std::uint64_t count,
                                      const std::string& meaning) const;
  /// A scalar string dataset (at most 64 MiB).
  std::string read_text(const std::string& dataset) const;

  /// Rows [first, first + count) of a float64 dataset.
  void read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t count, double* values) const;
  /// The same of a float32 dataset.
  void read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t count, float* values) const;
  /// Column `column` (flat index within a row) of rows [0, count).
  void read_column(const std::string& dataset, std::uint64_t column, std::uint64_t count, double* values) const;

 private:
  std::string place(const std::string& object) const;
  const ObjectEntry& entry(const std::string& object) const;
  /// Null if there is no such object; the first link or broken object on the way to it.
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
  std::size_t number_ = 0;  ///< of this file there
  mutable std::map<std::string, ObjectEntry> known_;
};

/// How large arrays lie in a file: as they are, shuffled and deflated (for many zeros), or the same in larger pieces
/// and in a third of the time.
enum class Packing { none, small, fast };

/// Where something is written: a file or group, what messages call the file, and how large arrays lie in it.
struct Output {
  Id id = -1;
  std::string where;
  Packing packing = Packing::none;
};

// Writing, used by the writers of superelements and results. Missing groups on the way are made. Texts are UTF-8. All
// throw Error.
/// The groups on the way to a dataset, without times: equal contents give equal bytes whenever they are written.
void create_groups(Id file, const std::string& dataset);
void write_attribute(const Output& out, const std::string& object, const std::string& name, const std::string& value);
void write_attribute(const Output& out, const std::string& object, const std::string& name, double value);
void write_attribute(const Output& out, const std::string& object, const std::string& name, std::int32_t value);
void write_dataset(const Output& out, const std::string& dataset, const Shape& shape, const double* values);
void write_dataset(const Output& out, const std::string& dataset, const Shape& shape, const std::int32_t* values);
/// Writes all values of a list or vector.
template <class List>
void write_dataset(const Output& out, const std::string& dataset, const List& values) {
  write_dataset(out, dataset, {static_cast<std::uint64_t>(values.size())}, values.data());
}
/// Fixed-length, zero-padded strings (longest value decides), shape [values.size()].
void write_texts(const Output& out, const std::string& dataset, const std::vector<std::string>& values);
/// One scalar string; replaces an existing one.
void write_text(const Output& out, const std::string& dataset, const std::string& value);

/// A new file in memory (core driver, nothing on disk), and its bytes when all is written.
Handle create_in_memory(const std::string& where);
std::string file_image(Handle file, const std::string& where);

/// Switches off HDF5's own printing of errors and its work at exit; every opening function calls it.
void silence();

}  // namespace tisserand::formats::hdf5

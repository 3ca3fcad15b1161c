// Small owner of HDF5 objects: every read is bounded, typed and checked before memory is taken, every failure is an
// Error.
//
// Files are untrusted input. Nothing of hdf5.h is seen outside hdf5_*.cpp; identifiers are HDF5's 64-bit hid_t.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/error.hpp"

namespace tisserand::formats::hdf5 {

using Id = std::int64_t;
using Shape = std::vector<std::uint64_t>;

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

enum class ElementKind { float64, float32, integer, text, other };

/// What the file says about a dataset, before any of its data are read.
struct DatasetInfo {
  ElementKind kind = ElementKind::other;
  std::string type_text;           ///< in words, e.g. "32-bit float"
  Shape shape;                     ///< empty: scalar
  bool written = true;             ///< false: some of its storage was never written
  bool filtered = false;           ///< compressed or otherwise packed; checksums do not count
  std::uint64_t stored_bytes = 0;  ///< without checksums
};

/// Which files may be opened: only those that were closed properly, or also those of a run that still writes or was
/// killed.
enum class Completeness { closed, any };

/// "12 x 3"; "scalar" if empty.
std::string shape_text(const Shape& shape);

/// The Error of the HDF5 call that just failed: `action`, the reason of the operating system if there is one, the
/// remedy.
Error last_error(const std::string& action, const std::string& where, const std::string& remedy);

/// A file opened for reading. Object names are absolute paths; `object` = "/" is the root group.
class InputFile {
 public:
  /// Throws Error: no such file, no permission, a folder, not HDF5, cut short, not closed properly.
  InputFile(const std::string& path, Completeness completeness);

  const std::string& path() const { return path_; }
  bool closed_properly() const { return closed_properly_; }

  bool has(const std::string& object) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  /// Names of the links in a group (at most 10 000), sorted. Throws Error if there is no such group.
  std::vector<std::string> members(const std::string& group) const;
  std::vector<std::string> attributes(const std::string& object) const;

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

  /// Rows [first, first + count) of a float64 dataset of `width` values per row.
  void read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t count, double* values) const;
  /// The same of a float32 dataset.
  void read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t count, float* values) const;
  /// Column `column` (flat index within a row) of rows [0, count).
  void read_column(const std::string& dataset, std::uint64_t column, std::uint64_t count, double* values) const;

 private:
  std::string place(const std::string& object) const;
  Handle open_dataset(const std::string& dataset) const;
  Handle open_object(const std::string& object) const;
  void require(const std::string& dataset, ElementKind kind, const Shape& shape, const std::string& meaning) const;
  std::vector<std::string> read_all_texts(Id dataset, std::uint64_t count, const std::string& where) const;

  std::string path_;
  bool closed_properly_ = true;
  Handle file_;
};

/// The bytes that `read` returns in a child process; none if the child died or threw.
std::string read_apart(const std::string& path, const std::function<std::string()>& read);

/// What reading in a child process may take.
struct ReadingLimits {
  unsigned processor_seconds = 0;
  unsigned wall_seconds = 0;
};

/// Runs `read` in a child process first, because HDF5 itself can crash on damaged files. Throws Error if the child dies
/// or needs ten times the processor time of an ordinary read (HDF5 can also loop for ever), or, where it waits, much
/// more wall time than a slow disk; what `read` throws is left to be met again when the caller reads.
void rehearse(const std::string& path, const std::function<void()>& read);
void rehearse(const std::string& path, const std::function<void()>& read, const ReadingLimits& limits);

/// The same for many files in one child process, in their order; false if it dies or needs too long at one of them.
[[nodiscard]] bool survives(const std::vector<std::string>& paths, const std::function<void(const std::string&)>& read);

// Writing, used by the writers of superelements and results. `file` is a file or group identifier; missing groups on
// the way are made. Texts are UTF-8. All throw Error with `where` in front.
/// The groups on the way to a dataset, without times: equal contents give equal bytes whenever they are written.
void create_groups(Id file, const std::string& dataset);
void write_text_attribute(Id file, const std::string& object, const std::string& name, const std::string& value,
                          const std::string& where);
void write_number_attribute(Id file, const std::string& object, const std::string& name, double value,
                            const std::string& where);
void write_integer_attribute(Id file, const std::string& object, const std::string& name, std::int32_t value,
                             const std::string& where);
void write_dataset(Id file, const std::string& dataset, const Shape& shape, const double* values,
                   const std::string& where);
void write_dataset(Id file, const std::string& dataset, const Shape& shape, const std::int32_t* values,
                   const std::string& where);
/// Shuffled and deflated as well, with checksums: for large arrays with many zeros.
void write_compressed_dataset(Id file, const std::string& dataset, const Shape& shape, const double* values,
                              const std::string& where);
/// Fixed-length, zero-padded strings (longest value decides), shape [values.size()].
void write_texts(Id file, const std::string& dataset, const std::vector<std::string>& values, const std::string& where);
/// One scalar string; replaces an existing one.
void write_text(Id file, const std::string& dataset, const std::string& value, const std::string& where);

/// A new file in memory (core driver, nothing on disk), and its bytes when all is written.
Handle create_in_memory(const std::string& where);
std::string file_image(Handle file, const std::string& where);

/// Switches off HDF5's own printing of errors and its work at exit; every opening function calls it.
void silence();

}  // namespace tisserand::formats::hdf5

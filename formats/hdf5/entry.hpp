// SPDX-License-Identifier: GPL-3.0-or-later
// Plain descriptions of the objects of a file, sent from the process that reads with HDF5.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/confined/packing.hpp"

namespace tisserand::formats::hdf5 {

using Shape = std::vector<std::uint64_t>;

enum class ElementKind : std::uint8_t { float64, float32, integer, text, other };

/// Description of a dataset before its data are read.
struct DatasetInfo {
  ElementKind kind = ElementKind::other;
  std::string type_text;           ///< description, for example "32-bit float"
  Shape shape;                     ///< empty: scalar
  bool written = true;             ///< false: some of its storage was never written
  bool filtered = false;           ///< compressed or packed otherwise; a checksum alone is no filter
  std::uint64_t stored_bytes = 0;  ///< stored size without checksums
};

/// Files that may be opened. closed: properly closed files only. any: also files of a run that still writes or was
/// killed.
enum class Completeness { closed, any };

/// Largest number of listed members of a group, or of listed attributes of an object.
inline constexpr std::uint64_t max_members = 10000;

/// Reason why something is unavailable; empty if it is available.
struct Problem {
  std::string message, remedy;
};

/// Description of an attribute, with its value if it is one text or one number.
struct AttributeEntry {
  enum class Kind : std::uint8_t { text, number, other };

  std::string name;
  Kind kind = Kind::other;
  std::string type_text;
  std::uint64_t count = 0;  ///< number of values; only one is read
  std::string text;
  double number = 0.0;
  Problem problem;
};

enum class ObjectState : std::uint8_t { absent, unknown, link, broken, group, dataset, other };

/// Description of an object of a file: a group, a dataset, or why it cannot be read.
struct ObjectEntry {
  std::string name;  ///< absolute path
  ObjectState state = ObjectState::absent;
  Problem problem;                         ///< reason for unknown or broken objects, lists of groups, infos of datasets
  std::vector<std::string> members;        ///< sorted; at most max_members
  std::vector<AttributeEntry> attributes;  ///< at most max_members
  Problem attribute_problem;
  DatasetInfo info;
  /// Answer for all values or texts of a small dataset, which is sent when the file is opened; or empty.
  std::string whole;
};

void pack(Packer& to, const ObjectEntry& entry);
/// Reads an entry that pack() wrote. Throws Error if the bytes do not form an entry.
ObjectEntry unpack_entry(Unpacker& from);

/// Requested values of a dataset: all, or rows [first, first + count) with all columns or with one.
struct ValuesRequest {
  enum class Part : std::uint8_t { all, rows, column };
  enum class Type : std::uint8_t { float64, float32, int64 };

  std::string dataset;
  Part part = Part::all;
  Type type = Type::float64;
  std::uint64_t first = 0, count = 0, column = 0;
  std::uint64_t values = 0;  ///< expected number of values
};

/// Function that returns the memory for an answer of `bytes` bytes.
using Place = std::function<char*(std::uint64_t bytes)>;

std::string entry_request(const std::string& object);
std::string texts_request(const std::string& dataset, std::uint64_t count);
std::string values_request(const ValuesRequest& request);

class Container;
/// First answer of the reading process, sent when a file is opened: whether the file was closed properly, and its first
/// objects.
std::string opening_of(const Container& container);
/// Stores at `place` the answer to a request made by entry_request(), texts_request() or values_request(). Throws
/// Error.
void answer(const Container& container, std::string_view request, const Place& place);

}  // namespace tisserand::formats::hdf5

// What a file says about one of its objects: the plain form in which it leaves the process that reads with HDF5.
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

/// Names that are listed of a group or of the attributes of an object.
inline constexpr std::uint64_t max_members = 10000;

/// Why something cannot be had; empty: it can.
struct Problem {
  std::string message, remedy;
};

struct AttributeEntry {
  enum class Kind : std::uint8_t { text, number, other };

  std::string name;
  Kind kind = Kind::other;
  std::string type_text;
  std::uint64_t count = 0;  ///< of values; only one is read
  std::string text;
  double number = 0.0;
  Problem problem;
};

enum class ObjectState : std::uint8_t { absent, unknown, link, broken, group, dataset, other };

struct ObjectEntry {
  std::string name;  ///< absolute path
  ObjectState state = ObjectState::absent;
  Problem problem;                         ///< of what is unknown or broken, of a group's list, of a dataset's info
  std::vector<std::string> members;        ///< sorted; at most max_members
  std::vector<AttributeEntry> attributes;  ///< at most max_members
  Problem attribute_problem;
  DatasetInfo info;
  std::string whole;  ///< the answer to a request for all values or texts, of a small dataset at the opening; or empty
};

void pack(Packer& to, const ObjectEntry& entry);
/// Throws Error if the bytes are no entry.
ObjectEntry unpack_entry(Unpacker& from);

/// Which values of a dataset: rows [first, first + count) with all of their columns, or with one; or all values.
struct ValuesRequest {
  enum class Part : std::uint8_t { all, rows, column };
  enum class Type : std::uint8_t { float64, float32, int64 };

  std::string dataset;
  Part part = Part::all;
  Type type = Type::float64;
  std::uint64_t first = 0, count = 0, column = 0;
  std::uint64_t values = 0;  ///< how many are expected
};

/// Gives the room for an answer of this many bytes.
using Place = std::function<char*(std::uint64_t bytes)>;

std::string entry_request(const std::string& object);
std::string texts_request(const std::string& dataset, std::uint64_t count);
std::string values_request(const ValuesRequest& request);

class Container;
/// In the process that reads: the first answer, which nobody asks for: how the file was closed, and its first objects.
std::string opening_of(const Container& container);
/// The answer to one of the requests above. Throws Error.
void answer(const Container& container, std::string_view request, const Place& place);

}  // namespace tisserand::formats::hdf5

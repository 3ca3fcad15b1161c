// SPDX-License-Identifier: GPL-3.0-or-later
// Serialises data for another process on this machine. The reader checks everything, since a harmful file may have
// taken control of the process that sent the bytes.
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand {

/// Packs numbers, texts, lists and errors into bytes, which Unpacker reads in the order of packing.
class Packer {
 public:
  template <class T>
  void value(T value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(std::string_view text) {
    value(text.size());
    bytes += text;
  }
  template <class T>
  void row(const std::vector<T>& values) {
    value(values.size());
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void error(const Error& error) {
    for (const std::string& part : {error.message(), error.where(), error.remedy()}) text(part);
  }
  std::string bytes;
};

/// Reads the values that Packer packed, from untrusted bytes. Throws Error if the bytes do not fit.
class Unpacker {
 public:
  /// `bytes`: packed data; requires that `file` outlives this object. `made`: beginning of the error message if the
  /// bytes do not fit, for example "what gmsh made of it is no mesh".
  Unpacker(std::string_view bytes, const std::string& file, const char* made)
      : left_(bytes), file_(file), made_(made) {}

  template <class T>
  T value() {
    static_assert(std::is_arithmetic_v<T>);
    T result{};
    std::memcpy(&result, take(sizeof result).data(), sizeof result);
    return result;
  }
  bool flag() { return value<std::uint8_t>() != 0; }
  std::string raw_text() { return std::string(take(size(1))); }
  std::string text() { return printable_line(raw_text(), longest_text); }
  template <class T>
  std::vector<T> row() {
    static_assert(std::is_arithmetic_v<T>);
    std::vector<T> values(size(sizeof(T)));
    const std::string_view bytes = take(values.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  Error error() {
    const std::string what = text(), where = text(), remedy = text();
    return Error(what, where, remedy);
  }
  /// Reads a number of items. Throws Error unless the remaining bytes can hold that many items of `least` bytes each.
  std::size_t size(std::size_t least) {
    const auto count = value<std::size_t>();
    require(count <= left_.size() / least && count <= std::numeric_limits<int>::max(), "it is too short");
    return count;
  }
  void require(bool fits, const char* what) const {
    if (!fits)
      throw Error(fmt::format("{}: {}", made_, what), file_, "the file is damaged or malicious: do not use it");
  }
  bool is_at_end() const { return left_.empty(); }
  void end() const { require(is_at_end(), "it is too long"); }

 private:
  static constexpr std::size_t longest_text = 4000;

  std::string_view take(std::size_t count) {
    require(count <= left_.size(), "it is too short");
    const std::string_view bytes = left_.substr(0, count);
    left_.remove_prefix(count);
    return bytes;
  }
  std::string_view left_;
  const std::string& file_;
  const char* made_;
};

}  // namespace tisserand

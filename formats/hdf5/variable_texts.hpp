// SPDX-License-Identifier: GPL-3.0-or-later
// Reads texts of variable length without HDF5. HDF5 1.10.8 (H5HG_read) copies as many bytes as the heap states into
// a buffer of the length that the reference states, so a crafted file can overflow it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

/// Reader of texts of variable length in an HDF5 file.
class VariableTexts {
 public:
  /// `descriptor` is the open file that HDF5 knows as `file`.
  VariableTexts(int descriptor, Id file);

  /// Reads `count` texts, each cut off at its first zero byte. `read`: fills a buffer with the references of the file,
  /// as elements of `type`. Throws Error at `where` if a reference does not match its text, or if all texts exceed
  /// `most` bytes.
  std::vector<std::string> read(std::uint64_t count, std::uint64_t most, const std::string& where,
                                const std::function<bool(Id type, void* references)>& read);

 private:
  struct Item {
    std::uint64_t index = 0, begin = 0, size = 0;
  };

  void load(std::uint64_t address, const std::string& where);
  std::string text_at(std::uint64_t address, std::uint64_t index, std::uint64_t length, const std::string& where);
  std::uint64_t number(const char* bytes, std::uint64_t size) const;

  int descriptor_;
  std::uint64_t address_bytes_ = 8, length_bytes_ = 8, begin_ = 0;  ///< sizes and start of this file
  std::uint64_t loaded_ = 0;                                        ///< address of the collection below; 0: none
  std::string collection_;
  std::vector<Item> items_;
};

}  // namespace tisserand::formats::hdf5

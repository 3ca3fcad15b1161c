// SPDX-License-Identifier: GPL-3.0-or-later
// SHA-256 of byte sequences, which identifies superelements (content_id) and inputs.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace tisserand {

/// Incremental SHA-256 (FIPS 180-4): add() any number of times, then hex() once.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(const void* data, std::size_t bytes);
  /// Hash of all added data as 64 lower-case hexadecimal digits. It ends the computation.
  std::string hex();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// SHA-256 of a text, 64 lower-case hexadecimal digits.
std::string sha256_hex(const std::string& bytes);

/// SHA-256 of a file, 64 lower-case hexadecimal digits. Empty if the file cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace tisserand

// SHA-256 of byte sequences: identity of superelements (content_id) and of inputs.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace tisserand {

/// Running SHA-256 (FIPS 180-4). add() in any pieces, then hex() once.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(const void* data, std::size_t bytes);
  /// 64 lower-case hexadecimal digits; ends the computation.
  std::string hex();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// SHA-256 of a text, 64 lower-case hexadecimal digits.
std::string sha256_hex(const std::string& bytes);

/// The same of a file; empty if it is no file that can be read.
std::string sha256_of_file(const std::string& path);

}  // namespace tisserand

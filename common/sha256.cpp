// SPDX-License-Identifier: GPL-3.0-or-later
// SHA-256 by OpenSSL's functions for this digest. The EVP interface would initialise the whole library (all algorithms,
// a configuration file), which costs 2 ms per run.
#include "common/sha256.hpp"

#include <filesystem>
#include <fstream>
#include <vector>

#define OPENSSL_SUPPRESS_DEPRECATED  // OpenSSL 3 recommends EVP for all digests
#include <openssl/sha.h>

#include "common/error.hpp"

namespace tisserand {

struct Sha256::Impl {
  SHA256_CTX context;
};

Sha256::Sha256() : impl_(std::make_unique<Impl>()) { SHA256_Init(&impl_->context); }

Sha256::~Sha256() = default;

void Sha256::add(const void* data, std::size_t bytes) {
  const int ok = SHA256_Update(&impl_->context, data, bytes);
  TISSERAND_ENSURE(ok == 1, "SHA256_Update returned {}", ok);
}

std::string Sha256::hex() {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  const int ok = SHA256_Final(digest, &impl_->context);
  TISSERAND_ENSURE(ok == 1, "SHA256_Final returned {}", ok);
  std::string text;
  for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

std::string sha256_hex(const std::string& bytes) {
  Sha256 sha;
  sha.add(bytes.data(), bytes.size());
  return sha.hex();
}

std::string sha256_of_file(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  Sha256 sha;
  std::vector<char> block(std::size_t{1} << 16);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0)
    sha.add(block.data(), static_cast<std::size_t>(file.gcount()));
  return sha.hex();
}

}  // namespace tisserand

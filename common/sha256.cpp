// SHA-256 by OpenSSL's EVP interface.
#include "common/sha256.hpp"

#include <openssl/evp.h>

#include "common/error.hpp"

namespace tisserand {

struct Sha256::Impl {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~Impl() { EVP_MD_CTX_free(context); }
};

Sha256::Sha256() : impl_(std::make_unique<Impl>()) {
  const bool started = impl_->context != nullptr && EVP_DigestInit_ex(impl_->context, EVP_sha256(), nullptr) == 1;
  if (!started) throw Error("SHA-256 is not available in OpenSSL", "", "check the installation of libssl");
}

Sha256::~Sha256() = default;

void Sha256::add(const void* data, std::size_t bytes) {
  const int ok = EVP_DigestUpdate(impl_->context, data, bytes);
  TISSERAND_ENSURE(ok == 1, "EVP_DigestUpdate returned {}", ok);
}

std::string Sha256::hex() {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  const int ok = EVP_DigestFinal_ex(impl_->context, digest, &size);
  TISSERAND_ENSURE(ok == 1 && size == 32, "EVP_DigestFinal_ex returned {} with {} bytes", ok, size);
  std::string text;
  for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string sha256_hex(const std::string& bytes) {
  Sha256 sha;
  sha.add(bytes.data(), bytes.size());
  return sha.hex();
}

}  // namespace tisserand

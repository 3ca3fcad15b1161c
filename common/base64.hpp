// SPDX-License-Identifier: GPL-3.0-or-later
// Base64: bytes written as text (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace tisserand {

/// Base64 text of the bytes.
std::string base64(const std::string& bytes);

/// Bytes that a base64 text encodes, up to the first character outside the alphabet.
std::string base64_decoded(std::string_view text);

}  // namespace tisserand

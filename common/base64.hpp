// Bytes as text (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace tisserand {

std::string base64(const std::string& bytes);

/// Back, to the first character that is none of its letters.
std::string base64_decoded(std::string_view text);

}  // namespace tisserand

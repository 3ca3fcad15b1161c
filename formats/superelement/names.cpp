// SPDX-License-Identifier: GPL-3.0-or-later
// Check of names.
#include "formats/superelement/names.hpp"

#include <algorithm>

namespace tisserand::formats {

bool valid_name(const std::string& name) {
  if (name.empty() || name.size() > 255) return false;
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto digit = [](char c) { return (c >= '0' && c <= '9') || c == '-'; };
  return letter(name[0]) && std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || digit(c); });
}

}  // namespace tisserand::formats

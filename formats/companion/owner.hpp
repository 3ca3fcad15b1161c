// SPDX-License-Identifier: GPL-3.0-or-later
// Identification of a companion file, before its data are used.
#pragma once

#include <optional>
#include <string>

namespace tisserand::formats {

/// Attributes of a companion file: who wrote it, and for which superelement.
struct CompanionOwner {
  std::string producer;
  std::string superelement;  ///< content_id
};

/// Owner by the attributes of the file alone. Empty if it is not a readable companion file.
std::optional<CompanionOwner> companion_owner(const std::string& path);

}  // namespace tisserand::formats

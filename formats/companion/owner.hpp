// SPDX-License-Identifier: GPL-3.0-or-later
// Identification of a companion file, before its data are used.
#pragma once

#include <optional>
#include <string>

namespace tisserand::formats {

/// Owner of a companion file by its attributes: the program that wrote it, and the superelement to which it belongs.
struct CompanionOwner {
  std::string producer;
  std::string superelement;  ///< content_id of the superelement
};

/// Owner of a companion file, read from its attributes alone. Nothing if the file is not a readable companion file.
std::optional<CompanionOwner> companion_owner(const std::string& path);

}  // namespace tisserand::formats

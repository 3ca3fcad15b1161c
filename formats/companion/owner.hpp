// Whose companion a file is, before anything of it is used.
#pragma once

#include <optional>
#include <string>

namespace tisserand::formats {

/// What a companion file says of itself.
struct CompanionOwner {
  std::string producer;
  std::string superelement;  ///< content_id
};

/// By the attributes of the file alone; none where it is no companion file that can be read.
std::optional<CompanionOwner> companion_owner(const std::string& path);

}  // namespace tisserand::formats

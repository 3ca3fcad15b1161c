// SPDX-License-Identifier: GPL-3.0-or-later
// Treatment of each keyword of a deck by read_abaqus().
#pragma once

#include <optional>
#include <string_view>

namespace tisserand::reducer::abaqus {

enum class KeywordRole {
  defines,  ///< read as a block
  follows,  ///< read with the preceding keyword, such as *KINEMATIC after *COUPLING
  silent,   ///< titles and output requests
  skipped   ///< without effect on stiffness and mass; listed in a warning
};

/// Role of a keyword in upper case without blanks; empty if it is not supported.
std::optional<KeywordRole> keyword_role(std::string_view keyword);

}  // namespace tisserand::reducer::abaqus

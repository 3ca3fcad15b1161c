// SPDX-License-Identifier: GPL-3.0-or-later
// Treatment of each keyword of a deck by read_abaqus().
#pragma once

#include <optional>
#include <string_view>

namespace tisserand::reducer::abaqus {

/// Treatment of a keyword by the reader of Abaqus and CalculiX decks.
enum class KeywordRole {
  defines,  ///< the keyword is read as a block
  follows,  ///< the keyword is read with the preceding one, such as *KINEMATIC after *COUPLING
  silent,   ///< titles and output requests
  skipped   ///< without effect on stiffness and mass; listed in a warning
};

/// Role of a keyword, which is in upper case without blanks. Returns nothing if the reader does not support it.
std::optional<KeywordRole> keyword_role(std::string_view keyword);

}  // namespace tisserand::reducer::abaqus

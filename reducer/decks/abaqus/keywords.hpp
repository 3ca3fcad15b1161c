// What read_abaqus() does with each keyword of a deck.
#pragma once

#include <optional>
#include <string_view>

namespace tisserand::reducer::abaqus {

enum class KeywordRole {
  defines,  ///< read on its own
  follows,  ///< read with the keyword before it, such as *KINEMATIC after *COUPLING
  silent,   ///< titles and wishes for output
  skipped   ///< without effect on stiffness and mass; listed in a warning
};

/// Nothing for keywords that are not understood. `keyword` in upper case without blanks.
std::optional<KeywordRole> keyword_role(std::string_view keyword);

}  // namespace tisserand::reducer::abaqus

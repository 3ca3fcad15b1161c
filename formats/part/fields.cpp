// SPDX-License-Identifier: GPL-3.0-or-later
// All lists of fields of part.yaml, and the types that they refer to.
#include "formats/part/fields.hpp"

#include "formats/part/reader.hpp"
#include "formats/sections/reader.hpp"

namespace tisserand::formats {

std::vector<KeySet> part_key_sets() {
  std::vector<KeySet> sets{{"part", part_fields()}, {"accuracy", accuracy_fields()}};
  for (const auto& lists : {common_key_sets(), section_key_sets(), place_key_sets(), patch_key_sets(), shell_key_sets(),
                            attachment_key_sets(), load_key_sets()})
    sets.insert(sets.end(), lists.begin(), lists.end());
  return sets;
}

std::vector<NamedType> part_types() {
  std::vector<NamedType> types{{"position", "vector | name"},
                               {"at", "vector | name | place"},
                               {"text_list", "text+ | [text+]", "names of groups, one or a list"},
                               {"numbers", "integer | [integer]"},
                               {"component", "'x' | 'y' | 'z' | 'rx' | 'ry' | 'rz'"},
                               {"components", "component | [component]"},
                               {"held", "'all' | 'translations' | 'rotations' | components"}};
  for (const auto& more : {common_types(), section_types()}) types.insert(types.end(), more.begin(), more.end());
  return types;
}

}  // namespace tisserand::formats

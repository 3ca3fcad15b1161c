// SPDX-License-Identifier: GPL-3.0-or-later
// Fields with a shared meaning, and types and lists of both kinds of files.
#include "formats/yaml/field.hpp"

#include <algorithm>

namespace tisserand::formats {

std::vector<Field> shared_fields(std::string_view table, std::vector<Field> fields) {
  const Field* before = nullptr;
  for (Field& field : fields) {
    field.table = table;
    field.same_row = field.meaning == ditto;
    if (field.same_row) {
      field.meaning = before->meaning;
      field.fallback = before->fallback;
      field.standard = before->standard;
    }
    before = &field;
  }
  return fields;
}

KeySet::KeySet(std::string_view own_noun, std::vector<Field> own, const std::vector<Field>& shared, KeyCount key_count)
    : noun(own_noun), fields(shared_fields(own_noun, std::move(own))), count(key_count) {
  fields.insert(fields.end(), shared.begin(), shared.end());
}

std::vector<std::string_view> collection_keys(const std::vector<KeySet>& sets) {
  std::vector<std::string_view> keys;
  for (const KeySet& set : sets)
    for (const Field& field : set.fields)
      if (field.type.starts_with("{") && !field.type.starts_with("{text") &&
          std::ranges::find(keys, field.key) == keys.end())
        keys.push_back(field.key);
  return keys;
}

std::vector<NamedType> common_types() {
  return {{"name", "/^[A-Za-z_][A-Za-z0-9_-]*$/"},
          {"positive", "number>0"},
          {"not_negative", "number>=0"},
          {"count", "integer>=1"},
          {"number_of", "integer>=0"},
          {"vector", "[number]3"},
          {"matrix", "[vector]3"},
          {"six", "[number]6"},
          {"six_by_six", "six | [six]6", "[x, y, z, rx, ry, rz] of the diagonal, or six rows"},
          {"inertia_tensor", "vector | [number]6 | matrix",
           "[Ixx, Iyy, Izz], [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] (tensor entries) or three rows"},
          {"rotation", "[number]4 | matrix | orientation", "[w, x, y, z], three rows, {axis, angle_deg} or two axes"}};
}

std::vector<KeySet> common_key_sets() {
  return {{"units",
           {{"length", "'m' | 'mm' | 'cm' | 'km' | 'in' | 'ft'", "", "required"},
            {"mass", "'kg' | 'g' | 't' | 'lb' | 'slug'", "", "required"},
            {"time", "'s' | 'ms'", "", "required"}}},
          {"orientation",
           {{"axis", "vector", ""},
            {"angle_deg", "number", ""},
            {"x", "vector", ""},
            {"y", "vector", ""},
            {"z", "vector", ""}},
           {},
           {2, 2}}};
}

}  // namespace tisserand::formats

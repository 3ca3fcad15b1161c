// SPDX-License-Identifier: GPL-3.0-or-later
// All lists of fields of scene.yaml, assemblies and instances, and the types that they refer to.
#include "formats/scene/fields.hpp"

#include <algorithm>

#include "formats/scene/integrator_reader.hpp"
#include "formats/scene/reader.hpp"
#include "formats/scene/time_function_reader.hpp"
#include "formats/sections/reader.hpp"

namespace tisserand::formats {
namespace {

/// Fields that an assembly shares with a scene: maps from names.
std::vector<Field> assembly_fields() {
  std::vector<Field> fields{{"assembly", "text", "title, if the assembly is a file of its own"},
                            {"parameters", "{parameter_name: any}", "parameters with their default values"},
                            {"assemblies", "{name: text | assembly}", "as in a scene"},
                            {"instances", "{name: instance}", ditto}};
  for (const std::string_view key : collection_keys({{"scene", scene_fields()}}))
    if (key != "analyses" && key != "roads" && std::ranges::find(fields, key, &Field::key) == fields.end())
      fields.push_back({key, "{name: any}", ditto});
  return fields;
}

KeySet instance_fields() {
  return {
      "instance",
      {{"use", "text", "name of an assembly", "required"},
       {"pose", "pose", "pose of its axes in the axes around it", "at the origin, unrotated"},
       {"mirror", "plane", "`yz`, `xz` or `xy`: mirror it at this plane of its axes, before the pose is applied", "no"},
       {"parameters", "{text: any}+", "values for the parameters of the assembly; an unknown name is an error",
        "its defaults"},
       {"count", "integer>=0<=200000", "number of copies, named `link[0]`, `link[1]`, ... (at most 200 000)",
        "one, named `link`"},
       {"step", "pose", "pose of each copy in the axes of the previous one", "none"},
       {"first", "{text: any}+", "parameters of the first copy that differ from those of the others", "none"}}};
}

}  // namespace

std::vector<KeySet> scene_key_sets() {
  std::vector<KeySet> sets{{"scene", scene_fields()}, {"assembly", assembly_fields()}, instance_fields()};
  for (const auto& lists :
       {common_key_sets(), section_key_sets(), effect_key_sets(), body_key_sets(), shape_of_body_key_sets(),
        joint_key_sets(), force_key_sets(), tyre_key_sets(), channel_key_sets(), time_function_key_sets(),
        analysis_key_sets(), integrator_key_sets(), settings_key_sets()})
    sets.insert(sets.end(), lists.begin(), lists.end());
  return sets;
}

std::vector<NamedType> scene_types() {
  std::vector<NamedType> types{
      {"parameter_name", "/^[A-Za-z_][A-Za-z0-9_]*$/"},
      {"body", "body_superelement | body_rigid | body_rigid_from | body_beam | body_virtual | body_modal"},
      {"plane", "'yz' | 'xz' | 'xy'"},
      {"mirror", "plane | [plane]",
       "plane of the part frame at which the file is mirrored, before the pose; a list: one after another"},
      {"place", "text | marker", "ground, <body>, <body>/<node>, or a marker there"},
      {"function", "number | text+ | time_function", "a number, an expression, or a table or file"},
      {"motion_value", "number | text+ | motion_function",
       "a number, an expression, or a table or file with its interpolation"},
      shape_of_body_type()};
  for (const auto& more : {common_types(), section_types()}) types.insert(types.end(), more.begin(), more.end());
  return types;
}

}  // namespace tisserand::formats

// part.yaml to the struct Part.
#include "formats/part/part.hpp"

#include "formats/part/check.hpp"
#include "formats/part/keys.hpp"
#include "formats/part/reader.hpp"
#include "formats/sections/reader.hpp"
#include "formats/yaml/reader.hpp"
#include "formats/yaml/units_reader.hpp"

namespace tisserand::formats {

namespace {

ModeSelection read_modes(const MapReader& map) {
  ModeSelection modes;
  const bool both = map.has("modes") && map.has("cutoff");
  if (both)
    map.context().fail(map.find("cutoff")->key_place, "both 'modes' and 'cutoff' are given", "give one of them");
  modes.where = map.context().entry;
  modes.count = map.integer("modes", 0);
  if (map.has("cutoff")) modes.cutoff = map.number("cutoff");
  return modes;
}

Part read_tree(YamlReader& reader, const std::string& path) {
  const Context context{reader, "", path};
  const MapReader map(context, reader.root(), "part");
  Part part;
  part.file = path;
  part.name = map.text("part");
  part.units = read_units(map);
  read_part_materials(map, part);
  part.sections = read_sections(map, part.units);
  read_part_points(map, part);
  read_mesh_file(map, part);
  read_groups(map, part);
  read_patches(map, part);
  read_shells_and_solids(map, part);
  read_beams(map, part);
  read_attachments(map, part);
  read_boundary(map, part);
  part.modes = read_modes(map);
  return part;
}

}  // namespace

Part read_part(const std::string& path, const std::vector<Override>& overrides) {
  YamlDocument document = load_yaml(path);
  apply_overrides(document, overrides, part_collections());
  YamlReader reader(document, part_key_sets());
  require_kind(reader, "part", "scene", "give it to `mechanism run`");
  Part part = read_tree(reader, path);
  reader.raise(find_faults(part));
  return part;
}

}  // namespace tisserand::formats

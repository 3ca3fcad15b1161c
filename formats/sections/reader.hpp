// Materials and beam sections of part.yaml and scene.yaml.
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/sections/section.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Lists of materials, sections by constants and the shapes, and types that they refer to.
std::vector<KeySet> section_key_sets();
std::vector<NamedType> section_types();

/// `context` names the entry; `prefix` precedes the keys in findings when the map stands inside another entry.
Material read_material(const Context& context, const YamlNode& node, const std::string& prefix);

/// By constants, by `shape` or by `stiffness`. Sizes that contradict each other are errors here, since a Section no
/// longer knows them.
Section read_section(const Context& context, const YamlNode& node, const Units& units, const std::string& prefix);

/// The top-level maps `materials` and `sections`.
std::vector<Material> read_materials(const MapReader& map);
std::vector<Section> read_sections(const MapReader& map, const Units& units);

/// Positive finite constants, -1 < nu < 0.5, Iy + Iz = polar moment, shear areas both or none.
void check_material(const Material& material, const Subject& subject);
void check_section(const Section& section, const Subject& subject);

}  // namespace tisserand::formats

// SPDX-License-Identifier: GPL-3.0-or-later
// Materials and beam sections of part.yaml and scene.yaml.
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/sections/section.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Fields of materials, and of sections by constants and by shape; section_types() returns the types to which they
/// refer.
std::vector<KeySet> section_key_sets();
std::vector<NamedType> section_types();

/// Reads a material. `context`: names the entry in messages. `prefix`: text before its keys in findings, for a map
/// inside another entry.
Material read_material(const Context& context, const YamlNode& node, const std::string& prefix);

/// Reads a section by constants, by `shape` or by `stiffness`. Contradictory sizes are reported here, since a Section
/// does not store them.
Section read_section(const Context& context, const YamlNode& node, const Units& units, const std::string& prefix);

/// Reads the top-level map `materials` or `sections`.
std::vector<Material> read_materials(const MapReader& map);
std::vector<Section> read_sections(const MapReader& map, const Units& units);

/// Checks that constants are positive and finite, that -1 < nu < 0.5, that Iy + Iz is the polar moment, and that both
/// shear areas are given or none.
void check_material(const Material& material, const Subject& subject);
void check_section(const Section& section, const Subject& subject);

}  // namespace tisserand::formats

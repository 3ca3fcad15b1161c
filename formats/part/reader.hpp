// SPDX-License-Identifier: GPL-3.0-or-later
// Functions by which part.cpp reads part.yaml, one for each kind of entry.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part/part.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

inline constexpr Choice<MassMatrix> mass_matrices[] = {{"consistent", MassMatrix::consistent},
                                                       {"lumped", MassMatrix::lumped}};
inline constexpr Choice<Cells> cell_words[] = {{"quadrilaterals", Cells::quadrilaterals},
                                               {"triangles", Cells::triangles}};

/// Reads coordinates [x, y, z], or the name of a point and returns its position. Requires that this point comes earlier
/// and has coordinates. Returns NaN after an error.
Eigen::Vector3d read_position(const Context& context, const YamlNode& node, const std::string& what, const Part& part);

/// Reads a place: a name, [x, y, z], or a map with one of the keys node, near, centroid.
Place read_place(const Context& context, const YamlNode& node, const std::string& what, const Part& part);
/// Reads a place from the keys node, near, tolerance and centroid of a map. Requires that the map has exactly one of
/// node, near and centroid.
Place read_place_keys(const MapReader& map, const Part& part);

/// Reads directions: one of x, y, z, rx, ry, rz, or a list of them. Returns bit 0-2 for translations and bit 3-5 for
/// rotations.
unsigned read_component_bits(const Context& context, const YamlNode& node, const std::string& what);
/// Reads an angle [degrees] and returns it in [rad]. `fallback`: value without the key [rad].
double read_angle(const MapReader& map, double fallback);

void read_part_materials(const MapReader& map, Part& part);
void read_part_points(const MapReader& map, Part& part);
void read_mesh_file(const MapReader& map, Part& part);
void read_groups(const MapReader& map, Part& part);
void read_patches(const MapReader& map, Part& part);
void read_shells_and_solids(const MapReader& map, Part& part);
void read_beams(const MapReader& map, Part& part);
void read_attachments(const MapReader& map, Part& part);
void read_boundary(const MapReader& map, Part& part);
void read_modal_body(const MapReader& map, Part& part);
/// Reads supports and load cases. Requires that points, spiders and boundary were read, since names of places have
/// priority over names of groups.
void read_loads(const MapReader& map, Part& part);

// Lists of fields, each defined with the functions that read them.
std::vector<Field> part_fields();
std::vector<Field> accuracy_fields();
std::vector<KeySet> place_key_sets();
std::vector<KeySet> patch_key_sets();
std::vector<KeySet> shell_key_sets();
std::vector<KeySet> attachment_key_sets();
std::vector<KeySet> load_key_sets();

}  // namespace tisserand::formats

// The pieces from which part.cpp reads part.yaml: one function for each kind of entry.
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

/// Coordinates, or the name of a point (then its position; it must come earlier and be given by coordinates).
/// Not-a-number after an error.
Eigen::Vector3d read_position(const Context& context, const YamlNode& node, const std::string& what, const Part& part);

/// A name, [x, y, z], or a map with one of node, near, centroid.
Place read_place(const Context& context, const YamlNode& node, const std::string& what, const Part& part);
/// The keys node, near, tolerance, centroid of a map that has just one of the three.
Place read_place_keys(const MapReader& map, const Part& part);

/// One of x, y, z, rx, ry, rz, or a list of them; bit 0-2 translations, bit 3-5 rotations.
unsigned read_component_bits(const Context& context, const YamlNode& node, const std::string& what);
/// An angle in degrees, as radians; `fallback` in radians.
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
/// After points, spiders and boundary: names of places come before those of groups.
void read_loads(const MapReader& map, Part& part);

// Lists of fields, each beside the functions that read them.
std::vector<Field> part_fields();
std::vector<Field> accuracy_fields();
std::vector<KeySet> place_key_sets();
std::vector<KeySet> patch_key_sets();
std::vector<KeySet> shell_key_sets();
std::vector<KeySet> attachment_key_sets();
std::vector<KeySet> load_key_sets();

}  // namespace tisserand::formats

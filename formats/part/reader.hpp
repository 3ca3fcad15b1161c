// The pieces from which part.cpp reads part.yaml: one function for each kind of entry.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part/part.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Coordinates, or the name of a point (then its position; it must come earlier and be given by coordinates).
/// Not-a-number after an error.
Eigen::Vector3d read_position(const Context& context, const YamlNode& node, const std::string& what, const Part& part);

/// A name, [x, y, z], or a map with one of node, near, centroid.
Place read_place(const Context& context, const YamlNode& node, const std::string& what, const Part& part);
/// The keys node, near, tolerance, centroid of a map that has just one of the three.
Place read_place_keys(const MapReader& map, const Part& part);

/// A name or a list of names.
std::vector<std::string> read_name_list(const Context& context, const YamlNode& node, const std::string& what);
/// An angle in degrees, as radians; `fallback` in radians.
double read_angle(const MapReader& map, double fallback);

MassMatrix read_mass_matrix(const MapReader& map);
Cells read_cells(const MapReader& map);

void read_part_materials(const MapReader& map, Part& part);
void read_part_points(const MapReader& map, Part& part);
void read_mesh_file(const MapReader& map, Part& part);
void read_groups(const MapReader& map, Part& part);
void read_patches(const MapReader& map, Part& part);
void read_shells_and_solids(const MapReader& map, Part& part);
void read_beams(const MapReader& map, Part& part);
void read_attachments(const MapReader& map, Part& part);
void read_boundary(const MapReader& map, Part& part);

}  // namespace tisserand::formats

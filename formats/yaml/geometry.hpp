// Vectors, orientations and inertia tensors in the notations that part.yaml and scene.yaml accept.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// [x, y, z]; not-a-number after an error.
Eigen::Vector3d read_vector(const Context& context, const YamlNode& node, const std::string& what);
Eigen::Vector3d read_vector(const MapReader& map, std::string_view key, const Eigen::Vector3d& fallback);
std::optional<Eigen::Vector3d> read_optional_vector(const MapReader& map, std::string_view key);

/// Three rows of three numbers.
Eigen::Matrix3d read_matrix(const Context& context, const YamlNode& node, const std::string& what);

/// [Ixx, Iyy, Izz], [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] (entries of the tensor, thus minus the products ∫xy dm) or three
/// rows.
Eigen::Matrix3d read_inertia(const Context& context, const YamlNode& node, const std::string& what);

/// Rotation from the axes described to the axes in which they are written: a quaternion [w, x, y, z], a rotation matrix
/// (three rows; its columns are the axes), {axis: [..], angle_deg: a}, or {x: [..], y: [..]} or another two of x, y, z
/// (the first in alphabetical order is kept, the second made normal to it). Unit norm within 1e-6 is demanded of the
/// quaternion and orthonormality within 1e-6 of the matrix; both are then normalised.
Eigen::Quaterniond read_orientation(const Context& context, const YamlNode& node, const std::string& what);

/// `yz`, `xz` or `xy` as the index of the axis across; none after an error.
std::optional<Eigen::Index> read_mirror_plane(const Context& context, const YamlNode& node);

}  // namespace tisserand::formats

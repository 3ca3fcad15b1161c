// SPDX-License-Identifier: GPL-3.0-or-later
// Readers of vectors, orientations and inertia tensors in the notations of part.yaml and scene.yaml.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Reads a vector [x, y, z]. Returns NaN after a recorded error.
Eigen::Vector3d read_vector(const Context& context, const YamlNode& node, const std::string& what);
Eigen::Vector3d read_vector(const MapReader& map, std::string_view key, const Eigen::Vector3d& fallback);
std::optional<Eigen::Vector3d> read_optional_vector(const MapReader& map, std::string_view key);

/// Reads a 3 x 3 matrix as three rows of three numbers.
Eigen::Matrix3d read_matrix(const Context& context, const YamlNode& node, const std::string& what);

/// Reads an inertia tensor: [Ixx, Iyy, Izz], [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] or three rows. The numbers are entries of
/// the tensor, so Ixy = −∫xy dm.
Eigen::Matrix3d read_inertia(const Context& context, const YamlNode& node, const std::string& what);

/// Reads a rotation from the described axes to the axes in which they are written. Forms: a quaternion [w, x, y, z]; a
/// rotation matrix (three rows; its columns are the described axes); {axis: [..], angle_deg: a}; or two of x, y, z such
/// as {x: [..], y: [..]}. Of two axes the first in alphabetical order is kept, and the second is made normal to it.
/// Unit norm of a quaternion and orthonormality of a matrix must hold within 1e-6 and are then made exact.
Eigen::Quaterniond read_orientation(const Context& context, const YamlNode& node, const std::string& what);

/// Reads a mirror plane `yz`, `xz` or `xy` and returns the index of the axis normal to it. Returns nothing after an
/// error.
std::optional<Eigen::Index> read_mirror_plane(const Context& context, const YamlNode& node);

}  // namespace tisserand::formats

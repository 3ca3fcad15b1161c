// SPDX-License-Identifier: GPL-3.0-or-later
// Surface triangles from STL and OBJ files of CAD and drawing programs.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tisserand::formats {

/// Surface of triangles, as indices of vertices.
struct TriangleSurface {
  std::vector<Eigen::Vector3d> vertices;  ///< in units of the file
  std::vector<std::array<int, 3>> triangles;
};

/// Reads a surface of triangles from an STL file (text or binary, by content) or an OBJ file (vertices and faces;
/// polygons become fans of triangles). The ending of the name decides. Equal vertices of STL are joined. Limits are 1
/// GiB and ten million triangles. Throws Error with the line or number of the triangle: missing or cut file, invalid or
/// infinite numbers, unknown indices, no triangle.
TriangleSurface read_surface_file(const std::string& path);

}  // namespace tisserand::formats

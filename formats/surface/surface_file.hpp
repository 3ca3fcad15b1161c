// Triangles of a surface from STL and OBJ files, which CAD and drawing programs write.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tisserand::formats {

struct TriangleSurface {
  std::vector<Eigen::Vector3d> vertices;  ///< in the lengths of the file
  std::vector<std::array<int, 3>> triangles;
};

/// STL (text or binary, by its content) or OBJ (vertices and faces; polygons become fans of triangles), by the ending
/// of the name. Equal vertices of STL are joined. At most 1 GiB and ten million triangles. Throws Error with the line,
/// or the number of the triangle: missing or cut file, numbers that are none or not finite, indices that do not exist,
/// no triangle.
TriangleSurface read_surface_file(const std::string& path);

}  // namespace tisserand::formats

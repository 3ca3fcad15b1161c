// Triangles and lines in body axes: solids of a scene, tubes and swept sections, thinning.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "formats/scene/shape.hpp"
#include "formats/sections/section.hpp"

namespace tisserand::formats {

struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<std::array<int, 2>> lines;

  int size() const { return count_of(vertices); }
  /// Appends another one.
  void add(const Surface& other);
};

/// The solid in the part frame. Of a file: its triangles, read now. Throws Error (formats/surface).
Surface surface_of(const ShapeSpec& shape);

Surface sphere(const Eigen::Vector3d& center, double radius);

/// Corners (y, z), counter-clockwise seen against x.
using Outline = std::vector<Eigen::Vector2d>;

/// The outer contour of a section by its shape and sizes about the axis of the beam; of others an ellipse or rectangle
/// with the same area and, as far as that goes, the same ratio of second moments. A section by stiffness, whose area is
/// unknown, gets `fallback` as its radius.
Outline outline_of(const Section& section, double fallback);

/// Stations of one outline each, `corners` vertices per station in order: side faces between neighbours, and both ends
/// closed. Vertices are left to the caller.
Surface swept_faces(int stations, int corners);

/// Lines that join points into one tree of least length.
std::vector<std::array<int, 2>> least_tree(const std::vector<Eigen::Vector3d>& points);

/// Which vertices stay, and the faces between them.
struct Thinned {
  std::vector<int> kept;  ///< of the old vertices
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> lines;
};

/// Vertex clustering (Rossignac and Borrel, Multi-resolution 3D approximations for rendering complex scenes, 1993): the
/// vertices in one cell of a cubic grid become the one nearest to their mean. The finest grid that keeps at most
/// `most`. Faces that lose a corner vanish, doubles too.
Thinned thinned(const Surface& surface, int most);

}  // namespace tisserand::formats

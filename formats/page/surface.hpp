// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles and lines in body axes: solids of a scene, tubes, swept sections, thinning.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "formats/scene/shape.hpp"
#include "formats/sections/section.hpp"

namespace tisserand::formats {

/// Surface of triangles, with lines.
struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<std::array<int, 2>> lines;

  int size() const { return count_of(vertices); }
  /// Appends another surface.
  void add(const Surface& other);
};

/// Surface of a visible solid in the part frame of its body. A mesh file is read now. Throws Error (formats/surface).
Surface surface_of(const ShapeSpec& shape);

Surface sphere(const Eigen::Vector3d& center, double radius);

/// Corners (y, z) of a contour, counter-clockwise seen against x.
using Outline = std::vector<Eigen::Vector2d>;

/// Outer contour of a section, about the axis of the beam. A general section becomes a rectangle with equal radii of
/// gyration or, if they are unknown, a circle of equal area. A section by stiffness without radii becomes a circle of
/// radius `fallback`.
Outline outline_of(const Section& section, double fallback);

/// Side faces between neighbouring stations of one swept outline, with both ends closed. Each station has `corners`
/// vertices, in order. The caller must set the vertices.
Surface swept_faces(int stations, int corners);

/// Lines (pairs of indices) that connect the points to one tree of least total length.
std::vector<std::array<int, 2>> least_tree(const std::vector<Eigen::Vector3d>& points);

/// Result of thinned(): the vertices that remain, and the faces and lines between them.
struct Thinned {
  std::vector<int> kept;  ///< indices of the old vertices
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> lines;
};

/// Surface thinned by vertex clustering (Rossignac and Borrel, Multi-resolution 3D approximations for rendering complex
/// scenes, 1993). Vertices in one cell of a cubic grid merge to the vertex nearest to their mean. The grid is the
/// finest that keeps at most `most` vertices. Faces that lose a corner and duplicate faces vanish.
Thinned thinned(const Surface& surface, int most);

}  // namespace tisserand::formats

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

struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<std::array<int, 2>> lines;

  int size() const { return count_of(vertices); }
  /// Appends another surface.
  void add(const Surface& other);
};

/// Surface of a solid in the part frame. A file is read now. Throws Error (formats/surface).
Surface surface_of(const ShapeSpec& shape);

Surface sphere(const Eigen::Vector3d& center, double radius);

/// Corners (y, z) of a contour, counter-clockwise seen against x.
using Outline = std::vector<Eigen::Vector2d>;

/// Outer contour of a section about the axis of the beam. General sections become a rectangle with the same radii of
/// gyration or, if these are unknown, a circle with the same area. A section by stiffness without them becomes a circle
/// of radius `fallback`.
Outline outline_of(const Section& section, double fallback);

/// Side faces between neighbouring stations of one outline each, with both ends closed. `corners` vertices per station,
/// in order. The caller sets the vertices.
Surface swept_faces(int stations, int corners);

/// Lines that connect the points to one tree of least length.
std::vector<std::array<int, 2>> least_tree(const std::vector<Eigen::Vector3d>& points);

/// Vertices that remain, and the faces between them.
struct Thinned {
  std::vector<int> kept;  ///< indices of the old vertices
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> lines;
};

/// Surface thinned by vertex clustering (Rossignac and Borrel, Multi-resolution 3D approximations for rendering complex
/// scenes, 1993). Vertices in a cell of a cubic grid merge to the one nearest to their mean. The grid is the finest
/// that keeps at most `most`. Faces that lose a corner and duplicates vanish.
Thinned thinned(const Surface& surface, int most);

}  // namespace tisserand::formats

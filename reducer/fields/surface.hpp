// What one sees of a mesh: triangles of shells and of the outer faces of solids, outlines of beam sections.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"
#include "formats/sections/section.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

struct Surface {
  std::vector<Eigen::Vector3i> triangle;  ///< nodes, counter-clockwise seen from outside
  std::vector<int> element;               ///< of the mesh, in the numbering of element_nodes()
};

/// Shells, split along their shorter diagonal, and the faces that only one solid has; faces of quadratic solids in
/// four or six triangles.
Surface surface(const Mesh& mesh);

/// Constants and outer contour of a section. Without a shape of its own: the rectangle of the same area and second
/// moments (of a rod the circle of the same area).
formats::RecoverySection recovery_section(const formats::Section& section);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Visible surface of a mesh: triangles of shells and of the outer faces of solids, outlines of beam sections.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"
#include "formats/sections/section.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Visible surface of a mesh as triangles.
struct Surface {
  std::vector<Eigen::Vector3i> triangle;  ///< nodes of each triangle, counter-clockwise seen from outside
  std::vector<int> element;               ///< element of each triangle, as number in element_nodes()
};

/// Visible surface of the mesh as triangles: shells, split along their shorter diagonal, and faces that only one solid
/// has. Faces of quadratic solids have four or six triangles.
Surface surface(const Mesh& mesh);

/// Constants and outer contour of a beam section for the recovery file. A section without a known shape gets the
/// rectangle of the same area and second moments (a rod the circle of the same area).
formats::RecoverySection recovery_section(const formats::Section& section);

}  // namespace tisserand::reducer

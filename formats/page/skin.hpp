// SPDX-License-Identifier: GPL-3.0-or-later
// Visible surface of the mesh in a recovery file, and its motion by the coordinates of the superelement.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "formats/page/surface.hpp"
#include "formats/recovery/recovery.hpp"

namespace tisserand::formats {

/// Attachment of a vertex to the mesh: at a node, or at a distance from it.
struct SkinCarrier {
  int node = 0;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< part axes, units of the file
  int beam = -1;                                  ///< beam whose section has this corner, at end `end`; -1: none
  int end = 0;
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< y, z about the axis of the beam
};

struct Skin {
  Surface surface;  ///< part frame and units of the file
  std::vector<SkinCarrier> carriers;
  std::vector<int> triangle_element, line_element;  ///< indices of Recovery::elements
};

/// Skin of a mesh: triangles of shells and solids, and each beam as its sections at both ends.
Skin skin_of(const Recovery& recovery);

/// Displacement of vertices per unit of each coordinate, 3 V x n: u + θ x arm, part axes and units of the file.
Eigen::MatrixXd shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

/// Stress [xx yy zz xy yz zx] of vertices per unit of each coordinate, 6 V x n, part axes, units of the file. It is the
/// mean over the elements at the node; shells on the face of the normal. Beams have the normal stress at the corner, 0
/// if the section is given by its stiffness (RECOVERY.md).
Eigen::MatrixXd stresses_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

/// Displacement (3 V x 12) and stress (6 V x 12) of the answers to inertia loads; no columns if the file has none.
Eigen::MatrixXd load_shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);
Eigen::MatrixXd load_stresses_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

/// Displacement of vertices per unit amplitude of each second-order shape, 3 V x shapes; no columns if the file has
/// none.
Eigen::MatrixXd second_order_shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

}  // namespace tisserand::formats

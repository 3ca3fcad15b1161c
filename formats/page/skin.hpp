// SPDX-License-Identifier: GPL-3.0-or-later
// Visible surface of the mesh in a recovery file, and its motion by the coordinates of the superelement.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "formats/page/surface.hpp"
#include "formats/recovery/recovery.hpp"

namespace tisserand::formats {

/// Attachment of a vertex of the skin to the mesh: at a node, or at a distance from a node.
struct SkinCarrier {
  int node = 0;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< part axes, units of the file
  int beam = -1;                                  ///< beam whose section has this corner, at end `end`; -1: none
  int end = 0;
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< y, z about the axis of the beam
};

/// Surface of a recovery file's mesh, with the attachment of each vertex and the element of each triangle and line.
struct Skin {
  Surface surface;  ///< part frame and units of the file
  std::vector<SkinCarrier> carriers;
  std::vector<int> triangle_element, line_element;  ///< indices of Recovery::elements
};

/// Surface of a recovery file's mesh, with the attachment of each vertex: triangles of shells and solids, and each beam
/// as its sections at both ends.
Skin skin_of(const Recovery& recovery);

/// Displacement of V vertices per unit of each of n coordinates (3 V x n): u + θ x arm for displacement u and rotation
/// θ of the node. Part axes, units of the file.
Eigen::MatrixXd shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

/// Stress [xx yy zz xy yz zx] of V vertices per unit of each of n coordinates (6 V x n), part axes, units of the file.
/// It is the mean over the elements at the node; shells count with the face of the normal. Beams have the normal stress
/// at the corner, which is 0 if the section is given by its stiffness (RECOVERY.md).
Eigen::MatrixXd stresses_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

/// Displacement (3 V x 12) of V vertices in the static answers to the twelve inertia loads; load_stresses_at() returns
/// the stress (6 V x 12). No columns if the file has no loads.
Eigen::MatrixXd load_shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);
Eigen::MatrixXd load_stresses_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

/// Displacement of V vertices per unit amplitude of each second-order shape (3 V x shapes). No columns if the file has
/// no such shapes.
Eigen::MatrixXd second_order_shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

}  // namespace tisserand::formats

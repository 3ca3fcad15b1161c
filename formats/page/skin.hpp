// What one sees of a mesh in a recovery file, and how the coordinates of its superelement move it.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "formats/page/surface.hpp"
#include "formats/recovery/recovery.hpp"

namespace tisserand::formats {

/// Where a vertex is on the mesh: at a node, or carried by it at a distance.
struct SkinCarrier {
  int node = 0;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< part axes, units of the file
  int beam = -1;                                  ///< of whose section it is a corner, and at which end; -1: none
  int end = 0;
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< y, z about the axis of the beam
};

struct Skin {
  Surface surface;  ///< part frame of the file, its units
  std::vector<SkinCarrier> carriers;
  std::vector<int> triangle_element, line_element;  ///< of Recovery::elements
};

/// Triangles of shells and solids, each beam as its sections at both ends.
Skin skin_of(const Recovery& recovery);

/// Displacement of vertices per unit of each coordinate, 3 V x n: u + θ x arm, part axes and units of the file.
Eigen::MatrixXd shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

/// Stress [xx yy zz xy yz zx] of vertices per unit of each coordinate, 6 V x n, part axes and units of the file: of
/// solids at the node, of shells on the face of the normal, means of what meets there; of beams the normal stress at
/// the corner, 0 where the section is given by its stiffness (RECOVERY.md).
Eigen::MatrixXd stresses_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

/// The same of the answers to inertia loads: 3 V x 12, 6 V x 12; without columns where the file has none.
Eigen::MatrixXd load_shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);
Eigen::MatrixXd load_stresses_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

/// Displacement of vertices per unit of the amplitude of each shape of second order, 3 V x shapes; without columns
/// where the file has none.
Eigen::MatrixXd second_order_shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers);

}  // namespace tisserand::formats

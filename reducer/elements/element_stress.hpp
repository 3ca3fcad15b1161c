// SPDX-License-Identifier: GPL-3.0-or-later
// Section forces and stresses of elements as matrices of the motion of their nodes, for recovery files.
#pragma once

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Section forces [N Vy Vz Mx My Mz] of a beam at end 1, then at end 2, about the beam axis in element axes. They are
/// the forces that the part beyond a section exerts on the part before it. Columns (12): the coordinates of both nodes
/// in part axes; offsets and releases are included.
Eigen::Matrix<double, 12, 12> beam_section_forces(const Mesh& mesh, const BeamElement& beam);

/// Stress resultants of a shell at the mean of its corners, in element axes (6 x (6 corners)). Rows: [xx yy xy] of the
/// membrane stress N/t, then of the bending stress 6M/t². The sum of both is the stress on the face to which the
/// normal points. Columns: the coordinates of the nodes. For a laminate the values are not stresses of plies.
Eigen::Matrix<double, 6, Eigen::Dynamic> shell_stress(const Mesh& mesh, const ShellElement& shell);

/// Stress [xx yy zz xy yz zx] of a solid at every node, in part axes ((6 nodes) x (3 nodes)). It is extrapolated from
/// the quadrature points of the stiffness, where stresses are most accurate. The extrapolation is linear in tetrahedra
/// and along each direction of hexahedra and prisms. Strains of incompatible displacements are included.
Eigen::MatrixXd solid_stress(const Mesh& mesh, const SolidElement& solid);

}  // namespace tisserand::reducer

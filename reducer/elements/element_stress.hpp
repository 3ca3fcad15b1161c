// SPDX-License-Identifier: GPL-3.0-or-later
// Section forces and stresses of elements as matrices of the motion of their nodes, for recovery files.
#pragma once

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// [N Vy Vz Mx My Mz] at end 1, then at end 2, in element axes about the beam axis: forces that the part beyond a
/// section exerts on the part before it. Columns: the twelve nodal coordinates, part axes (with offsets and releases).
Eigen::Matrix<double, 12, 12> beam_section_forces(const Mesh& mesh, const BeamElement& beam);

/// Resultants at the mean of the corners in element axes, 6 x (6 corners): [xx yy xy] of membrane N/t, then of bending
/// 6M/t². Their sum is the stress on the face of the normal. For a laminate they are not stresses of its plies.
Eigen::Matrix<double, 6, Eigen::Dynamic> shell_stress(const Mesh& mesh, const ShellElement& shell);

/// Stress [xx yy zz xy yz zx] at every node, part axes, node by node: (6 nodes) x (3 nodes). It is extrapolated from
/// the quadrature points of the stiffness, where stresses are most accurate (linear in tetrahedra and along each
/// direction of hexahedra and prisms). Incompatible displacements are included.
Eigen::MatrixXd solid_stress(const Mesh& mesh, const SolidElement& solid);

}  // namespace tisserand::reducer

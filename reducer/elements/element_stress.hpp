// What every element gives of forces and stresses for the motion of its nodes: beside its matrices, for recovery files.
#pragma once

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// [N Vy Vz Mx My Mz] at end 1, then at end 2, in element axes about the beam axis: what the part beyond exerts on the
/// part before. Of the twelve coordinates of the nodes, part axes (offsets and releases included).
Eigen::Matrix<double, 12, 12> beam_section_forces(const Mesh& mesh, const BeamElement& beam);

/// At the mean of the corners, element axes: [xx yy xy] of membrane N/t, then of bending 6M/t² (on the face of the
/// normal their sum). Resultants over the thickness: of a laminate these are no stresses of its plies. 6 x (6 corners).
Eigen::Matrix<double, 6, Eigen::Dynamic> shell_stress(const Mesh& mesh, const ShellElement& shell);

/// [xx yy zz xy yz zx] at every node, part axes, node by node: (6 nodes) x (3 nodes). By the polynomial of the
/// quadrature points of the stiffness, where stresses are most accurate (linear in tetrahedra and along each direction
/// of hexahedra and prisms), incompatible displacements included.
Eigen::MatrixXd solid_stress(const Mesh& mesh, const SolidElement& solid);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Consistent loads of elements: nodal forces that do the work of a distributed load on the element's displacements.
#pragma once

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Distributed load of a beam: force per length of its axis (`line`) and acceleration of gravity, both in part axes.
struct BeamLoad {
  Eigen::Vector3d line = Eigen::Vector3d::Zero();
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
};

/// Consistent load on the ends of the beam axis, in element axes (12 x 1). It is the work of the distributed load on
/// the exact displacements of the beam: cubic Hermite functions for Euler-Bernoulli, those of [FK93] with shear. So
/// the nodes of prismatic beams move exactly: a uniform load q gives the forces qL/2 and moments qL²/12. Gravity acts
/// through the mass matrix of the element. Released end forces are condensed.
Eigen::Matrix<double, 12, 1> beam_end_load(const Mesh& mesh, const BeamElement& beam, const BeamLoad& load);

/// Consistent load on the nodes of the beam, in part axes (12 x 1): beam_end_load() moved along the offsets.
Eigen::Matrix<double, 12, 1> beam_node_load(const Mesh& mesh, const BeamElement& beam, const BeamLoad& load);

/// Pressure forces −p ∫ N_i n dA on the corners of a shell, in part axes (3 x corners). The integral is over the
/// surface through the nodes, with its normal n. The N_i are linear or bilinear and give no moments, so plates deflect
/// like a sheet between the nodes (DECISIONS.md discusses moments of curved edges).
Eigen::Matrix3Xd shell_pressure_load(const Mesh& mesh, const ShellElement& shell, double pressure);

/// Pressure forces −p ∫ N_i n dA on the nodes of a face of a solid, in part axes (3 x nodes of the face). The face has
/// three, four, six or eight nodes, and its normal n points outward (FacePressure). The integral is exact because n dA
/// is a polynomial.
Eigen::Matrix3Xd face_pressure_load(const Mesh& mesh, const FacePressure& face);

/// Consistent forces on the nodes of a loaded edge (3 x nodes of the edge), by linear or quadratic shape functions.
Eigen::Matrix3Xd edge_line_load(const Mesh& mesh, const EdgeLineLoad& edge);

}  // namespace tisserand::reducer

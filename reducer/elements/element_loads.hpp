// SPDX-License-Identifier: GPL-3.0-or-later
// Consistent loads of elements: nodal forces that do the work of a distributed load on the element's displacements.
#pragma once

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Force per length of a beam's axis and acceleration of gravity, part axes.
struct BeamLoad {
  Eigen::Vector3d line = Eigen::Vector3d::Zero();
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
};

/// Load on the ends of the axis in element axes, with released end forces condensed. It is work on the beam's exact
/// solution (Hermite's cubics for Euler-Bernoulli, [FK93] with shear), so nodes of prismatic beams move exactly: a
/// uniform load q gives qL/2 and qL²/12. Gravity acts by the mass matrix of the element.
Eigen::Matrix<double, 12, 1> beam_end_load(const Mesh& mesh, const BeamElement& beam, const BeamLoad& load);

/// Load on the nodes in part axes; otherwise as beam_end_load().
Eigen::Matrix<double, 12, 1> beam_node_load(const Mesh& mesh, const BeamElement& beam, const BeamLoad& load);

/// Pressure forces −p ∫ N_i n dA on each corner of a shell, on the surface through its nodes: 3 x corners, part axes.
/// N_i are linear or bilinear and give no moments, so plates deflect like a sheet between the nodes (DECISIONS.md
/// discusses moments of curved edges).
Eigen::Matrix3Xd shell_pressure_load(const Mesh& mesh, const ShellElement& shell, double pressure);

/// Pressure forces −p ∫ N_i n dA on a face of three, four, six or eight nodes, n outward (FacePressure): 3 x count. The
/// integral is exact because n dA is a polynomial.
Eigen::Matrix3Xd face_pressure_load(const Mesh& mesh, const FacePressure& face);

/// Forces on the nodes of an edge with linear or quadratic shape functions: 3 x count.
Eigen::Matrix3Xd edge_line_load(const Mesh& mesh, const EdgeLineLoad& edge);

}  // namespace tisserand::reducer

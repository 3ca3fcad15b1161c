// Consistent loads of elements: forces on their nodes that do the work of a distributed load on the element's own
// displacements.
#pragma once

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// A force per length of a beam's axis and an acceleration that pulls at its mass, part axes.
struct BeamLoad {
  Eigen::Vector3d line = Eigen::Vector3d::Zero();
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
};

/// On the ends of the axis, element axes, released end forces condensed. Work on the exact solution of the beam
/// (Hermite's cubics for Euler-Bernoulli, those of [FK93] with shear), so that nodes of prismatic beams move exactly: a
/// uniform load q gives qL/2 and qL²/12. Gravity by the mass matrix of the element.
Eigen::Matrix<double, 12, 1> beam_end_load(const Mesh& mesh, const BeamElement& beam, const BeamLoad& load);

/// The same on its nodes, part axes.
Eigen::Matrix<double, 12, 1> beam_node_load(const Mesh& mesh, const BeamElement& beam, const BeamLoad& load);

/// −p ∫ N_i n dA on each corner of a shell, on the surface through its nodes: 3 x corners, part axes. Linear or
/// bilinear functions without moments: the plates' deflections are those of a sheet between the nodes (DECISIONS.md has
/// what moments of curved edges would do).
Eigen::Matrix3Xd shell_pressure_load(const Mesh& mesh, const ShellElement& shell, double pressure);

/// −p ∫ N_i n dA on a face of three, four, six or eight nodes, n outward (FacePressure): 3 x count. Exact: n dA is a
/// polynomial.
Eigen::Matrix3Xd face_pressure_load(const Mesh& mesh, const FacePressure& face);

/// Forces on the nodes of an edge, with linear or quadratic functions: 3 x count.
Eigen::Matrix3Xd edge_line_load(const Mesh& mesh, const EdgeLineLoad& edge);

}  // namespace tisserand::reducer

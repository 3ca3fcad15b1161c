// SPDX-License-Identifier: GPL-3.0-or-later
// Contribution of elements to the discretisation error: stresses at their most accurate points, and the excess of the
// element's energy over that of smooth stresses.
#pragma once

#include <array>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Stresses sampled inside one element for several modes. `place`: points in part axes (3 x points). `stress`: one
/// column for each mode of the first point, then for each mode of the next (rows x (points · modes)). Rows of shells
/// (6): [N; M] per length in element axes, as in ShellSection. Rows of solids (6): [xx yy zz xy yz zx] in part axes.
struct StressSamples {
  Eigen::Matrix3Xd place;
  Eigen::MatrixXd stress;
};

/// Computes the stresses of the element at its most accurate points, for the motions `u` of its nodes. Rows of `u` are
/// those of element_matrices(), with one column per mode. First-order elements are sampled a fifth of the way from the
/// middle to each corner (triangles: in the middle), where stresses are superconvergent [ZZ92a]. These points lie
/// close together, so the slope of stress inside one element matters for smoothing only where the mesh is one element
/// wide. Second-order elements are sampled at the points of reduced integration.
void sample_stresses(const Mesh& mesh, const ShellElement& shell, const Eigen::MatrixXd& u, StressSamples& out);
void sample_stresses(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& u, StressSamples& out);

/// Modes at the nodes of one element: motions `u` (rows as in element_matrices(), one column per mode) and ω² of each
/// mode.
struct ElementModes {
  const Eigen::MatrixXd& u;
  const Eigen::VectorXd& lambda;
};

/// Whether the shell ends at its edge from corner i to the next, i = 0 to 3: no shell continues it smoothly there.
using ShellEdges = std::array<bool, 4>;
/// Surface around a flat shell element, for energy_error(). A curved surface or edge that the mesh approximates lies h
/// above the flat element, with the slopes g = ∇h. To first order in g gᵀ the slopes change three things: the strain
/// by sym(g ⊗ ∇w) of a shallow shell, the area by ½ |g|², and the lengths along which derivatives are taken.
struct ShellSurround {
  ShellEdges ending{};
  Eigen::Matrix<double, 2, 4> slope = Eigen::Matrix<double, 2, 4>::Zero();  ///< ∇h at the corners (2 x 4), element axes
  Eigen::Matrix2d turn = Eigen::Matrix2d::Zero();  ///< change of ∇h over the size of the element (2 x 2)
  /// Mean distance of the curved free edge beyond the straight edge [length], which adds a strip; 0: no free edge.
  std::array<double, 4> bow{};
};
/// Contribution of a shell to λ_h − λ of each mode: E_h + λ (M_c − M_h) − HR(σ*, u) of THEORY (93). E_h = uᵀ S u and
/// M_h = uᵀ M u belong to the element, M_c to its consistent mass. HR of THEORY (92) takes the smooth stress σ* and
/// the displacements of the consistent mass, which are continuous. Like E_h it is twice a strain energy. Requires
/// modes with vᵀ M v = 1. The formula also holds for elements of assumed strains, stresses and shear. If E_h is the
/// energy of these displacements, the result is ‖σ* − σ_h‖² of [ZZ87].
///
/// `smooth`: σ* at the corners, [N; M; Q] in element axes (8 rows per corner). At an edge with `around.ending` the
/// twisting moment M_ns becomes shear along the edge. This happens in a layer of width δ = √(f_Q/f_M), about the
/// thickness, which σ* does not have. f_M and f_Q are the compliances of M_ns and of the shear along the edge. With
/// the layer M_ns (1 − e^(−y/δ)) and the shear in equilibrium with it, HR is smaller by ∫ 2 M_ns γ_s + δ f_M M_ns² ds,
/// where γ_s is the shear strain of the edge.
Eigen::VectorXd energy_error(const Mesh& mesh, const ShellElement& shell, const ElementModes& modes,
                             const Eigen::MatrixXd& smooth, const ShellSurround& around);
/// Contribution of a solid to λ_h − λ of each mode, THEORY (93). `smooth`: σ* at all nodes in part axes (6 rows per
/// node). Requires modes with vᵀ M v = 1.
Eigen::VectorXd energy_error(const Mesh& mesh, const SolidElement& solid, const ElementModes& modes,
                             const Eigen::MatrixXd& smooth);

/// Energy of the lack of equilibrium of smooth stresses inside a solid, per mode: ∫ (h/π)² |div σ* + λ ρ u|²/G dV. h
/// is the shortest of the three sizes of the element, G the shear modulus. `smooth`: σ* at all nodes in part axes (6
/// rows per node).
Eigen::VectorXd imbalance(const Mesh& mesh, const SolidElement& solid, const ElementModes& modes,
                          const Eigen::MatrixXd& smooth);

/// Twice the strain energy of the stresses s of an element, per mode: its area or volume times the mean over the
/// points of sᵀ C⁻¹ s, with the elasticity C. `stress`: as in StressSamples.
Eigen::VectorXd stress_energy(const Mesh& mesh, const ShellElement& shell, const Eigen::MatrixXd& stress, int modes);
Eigen::VectorXd stress_energy(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& stress, int modes);

/// Contribution of a beam to λ_h − λ of each mode, THEORY (93). The beam is exact for loads at its ends, so the error
/// is the energy of its own inertia between held ends, spread evenly over the length. For the load q across and p
/// along, per length, this is q² L⁵/(720 EI) + q² L³/(12 GA) + p² L³/(12 EA), with a term like the last one for
/// torsion ([Prz68] 5.6). A beam with releases has 240 in place of 720.
Eigen::VectorXd energy_error(const Mesh& mesh, const BeamElement& beam, const ElementModes& modes);

/// Number of corners of a solid, which are its first nodes.
int corner_count(SolidShape shape);
inline bool is_second_order(SolidShape shape) { return node_count(shape) > corner_count(shape); }
/// Two corners between which the node `node` of a solid lies in the middle of an edge. Requires a node after the
/// corners.
std::array<int, 2> ends_of_edge_node(SolidShape shape, int node);

/// Angle of a shell [rad], or solid angle of a solid [sr], at a corner.
double angle_at_corner(const Mesh& mesh, const ShellElement& shell, int corner);
double angle_at_corner(const Mesh& mesh, const SolidElement& solid, int corner);

}  // namespace tisserand::reducer

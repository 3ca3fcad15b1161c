// SPDX-License-Identifier: GPL-3.0-or-later
// Contribution of elements to the discretisation error: stresses at their most accurate points, and the excess of the
// element's energy over that of smooth stresses.
#pragma once

#include <array>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Places (3 x points, part axes) and stresses (6 x (points · modes), modes within a point). Shells: [N; M] per length
/// in element axes, as in ShellSection. Solids: [xx yy zz xy yz zx] in part axes.
struct StressSamples {
  Eigen::Matrix3Xd place;
  Eigen::MatrixXd stress;
};

/// Samples stresses for motions `u` of the nodes (rows as in element_matrices(), one column per mode). First-order
/// shapes are sampled near the middle (a fifth of the way to the corners), where they are superconvergent [ZZ92a]. So
/// the slope inside an element counts only if one element lies side by side. Second-order shapes: points of reduced
/// integration.
void sample_stresses(const Mesh& mesh, const ShellElement& shell, const Eigen::MatrixXd& u, StressSamples& out);
void sample_stresses(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& u, StressSamples& out);

/// Motions of the nodes of an element, rows as in element_matrices(), one column per mode, and ω² of each.
struct ElementModes {
  const Eigen::MatrixXd& u;
  const Eigen::VectorXd& lambda;
};

/// Error per mode, E_h + λ (M − M_h) − HR(σ*, u) of THEORY (93). E_h = uᵀ S u and M_h = uᵀ M u belong to the element, M
/// to its consistent mass. HR of THEORY (92) takes the smooth stress σ* and the continuous displacements of the
/// consistent mass. It is twice the strain energy, for modes with vᵀ M v = 1. If E_h is the energy of these
/// displacements the error is ‖σ* − σ_h‖² of [ZZ87]. It also holds for assumed strains, stresses and shear.
/// `smooth`: σ* at the corners of shells, [N; M; Q] in element axes, 8 rows each; at all nodes of solids, 6 rows each,
/// part axes. At edges where the shell does not continue smoothly (`ending[i]`: from corner i to the next) the twisting
/// moment M_ns becomes shear along the edge. This happens in a layer of width δ = √(f_Q/f_M), about the thickness,
/// which σ* lacks (f: compliances of M_ns and of shear along the edge). With M_ns(1 − e^(−y/δ)) and the shear in
/// equilibrium with it HR is less by ∫ 2 M_ns γ_s + δ f_M M_ns² ds, γ_s: shear strain of the edge. `ShellSurround`
/// describes a curved surface or edge: a finer mesh has nodes h above the flat element, with slopes g = ∇h. To first
/// order in g gᵀ this adds the strain sym(g ⊗ ∇w) of a shallow shell, the area ½ |g|² and the longer paths of
/// derivatives. `bow` adds a strip along a free edge.
using ShellEdges = std::array<bool, 4>;
struct ShellSurround {
  ShellEdges ending{};
  Eigen::Matrix<double, 2, 4> slope = Eigen::Matrix<double, 2, 4>::Zero();  ///< ∇h at the corners, element axes
  Eigen::Matrix2d turn = Eigen::Matrix2d::Zero();  ///< change of ∇h over the size of the element
  std::array<double, 4> bow{};  ///< mean distance of the curved edge beyond the straight one, for free edges
};
Eigen::VectorXd energy_error(const Mesh& mesh, const ShellElement& shell, const ElementModes& modes,
                             const Eigen::MatrixXd& smooth, const ShellSurround& around);
Eigen::VectorXd energy_error(const Mesh& mesh, const SolidElement& solid, const ElementModes& modes,
                             const Eigen::MatrixXd& smooth);

/// Lack of equilibrium of smooth stresses inside a solid, as energy per mode: ∫ (h/π)² |div σ* + λ ρ u|²/G dV, where h
/// is the shortest of its three sizes.
Eigen::VectorXd imbalance(const Mesh& mesh, const SolidElement& solid, const ElementModes& modes,
                          const Eigen::MatrixXd& smooth);

/// Size of the element times the mean over points of sᵀ C⁻¹ s, per mode; `stress` as in StressSamples.
Eigen::VectorXd stress_energy(const Mesh& mesh, const ShellElement& shell, const Eigen::MatrixXd& stress, int modes);
Eigen::VectorXd stress_energy(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& stress, int modes);

/// Error of a beam, which is exact for loads at its ends: the energy of its own inertia, spread evenly, between held
/// ends. q² L⁵/(720 EI) + q² L³/(12 GA) across, p² L³/(12 EA) along, likewise for torsion ([Prz68] 5.6). A beam with
/// releases has 240 for 720.
Eigen::VectorXd energy_error(const Mesh& mesh, const BeamElement& beam, const ElementModes& modes);

/// Number of corners, the first nodes of a solid, and the two corners between which each later node lies.
int corner_count(SolidShape shape);
inline bool is_second_order(SolidShape shape) { return node_count(shape) > corner_count(shape); }
std::array<int, 2> ends_of_edge_node(SolidShape shape, int node);

/// Angle of a shell, or solid angle of a solid, at a corner.
double angle_at_corner(const Mesh& mesh, const ShellElement& shell, int corner);
double angle_at_corner(const Mesh& mesh, const SolidElement& solid, int corner);

}  // namespace tisserand::reducer

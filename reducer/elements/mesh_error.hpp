// What every element gives for the error of the mesh: its stresses where they are most accurate, and by how much its
// energy exceeds what smooth stresses give.
#pragma once

#include <array>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Places (3 x points, part axes) and stresses (6 x (points · modes), modes within a point). Shells: [N; M] per length
/// in element axes, as in ShellSection; solids: [xx yy zz xy yz zx] in part axes.
struct StressSamples {
  Eigen::Matrix3Xd place;
  Eigen::MatrixXd stress;
};

/// Of motions `u` of the nodes, rows as in element_matrices(), one column per mode. First-order shapes: their stress
/// near the middle (at a fifth of the way to the corners), so that between elements the values of the middles decide
/// ([ZZ92a]: superconvergent there) and the slope inside counts only where a single element lies side by side.
/// Second-order shapes: at the points of reduced integration.
void sample_stresses(const Mesh& mesh, const ShellElement& shell, const Eigen::MatrixXd& u, StressSamples& out);
void sample_stresses(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& u, StressSamples& out);

/// Motions of the nodes of an element, rows as in element_matrices(), one column per mode, and ω² of each.
struct ElementModes {
  const Eigen::MatrixXd& u;
  const Eigen::VectorXd& lambda;
};

/// Per mode E_h + λ (M − M_h) − HR(σ*, u): E_h = uᵀ S u and M_h = uᵀ M u of the element, M of its consistent mass,
///   HR(σ*, u) = ∫ 2 σ*·ε(u) − σ*·C⁻¹ σ* dV
/// Hellinger and Reissner's functional of the smooth stress σ* and of the continuous displacements whose mass the
/// consistent matrix is. Twice the strain energy, for modes with vᵀ M v = 1. Where E_h is the energy of these
/// displacements it is ‖σ* − σ_h‖² of [ZZ87]; it also holds for assumed strains, stresses and shear, whose energy is
/// another. `smooth`: σ* at the corners of shells, [N; M; Q] in element axes, 8 rows each; at all nodes of solids, 6
/// rows each, part axes. At edges of shells beyond which nothing goes on smoothly (`ending[i]`: from corner i to the
/// next) the twisting moment M_ns passes into shear along the edge in a layer of width δ = √(f_Q/f_M), of the size of
/// the thickness (f: compliances of M_ns and of shear along the edge), that σ* does not have. With M_ns(1 − e^(−y/δ))
/// and the shear in equilibrium with it HR is less by ∫ 2 M_ns γ_s + δ f_M M_ns² ds, γ_s: shear strain of the edge.
/// Nodes on a curved surface or edge that a finer mesh follows (`ShellSurround`): h above the flat element, with the
/// slopes g = ∇h, adds to first order in g gᵀ the strain sym(g ⊗ ∇w) of a shallow shell, the area ½ |g|² and the
/// longer paths of derivatives; `bow` adds a strip along a free edge.
using ShellEdges = std::array<bool, 4>;
struct ShellSurround {
  ShellEdges ending{};
  Eigen::Matrix<double, 2, 4> slope = Eigen::Matrix<double, 2, 4>::Zero();  ///< ∇h at the corners, element axes
  Eigen::Matrix2d turn = Eigen::Matrix2d::Zero();  ///< by which ∇h changes over the size of the element
  std::array<double, 4> bow{};  ///< mean distance of the curved edge beyond the straight one, of free edges
};
Eigen::VectorXd energy_error(const Mesh& mesh, const ShellElement& shell, const ElementModes& modes,
                             const Eigen::MatrixXd& smooth, const ShellSurround& around);
Eigen::VectorXd energy_error(const Mesh& mesh, const SolidElement& solid, const ElementModes& modes,
                             const Eigen::MatrixXd& smooth);

/// Per mode what smooth stresses lack of equilibrium inside a solid, as energy: ∫ (h/π)² |div σ* + λ ρ u|²/G dV, h the
/// shortest of its three sizes.
Eigen::VectorXd imbalance(const Mesh& mesh, const SolidElement& solid, const ElementModes& modes,
                          const Eigen::MatrixXd& smooth);

/// Per mode the size of the element times the mean over points of sᵀ C⁻¹ s, `stress` as in StressSamples.
Eigen::VectorXd stress_energy(const Mesh& mesh, const ShellElement& shell, const Eigen::MatrixXd& stress, int modes);
Eigen::VectorXd stress_energy(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& stress, int modes);

/// energy_error() of a beam, which is exact for loads at its ends: the energy that its own inertia, spread evenly, has
/// between held ends: q² L⁵/(720 EI) + q² L³/(12 GA) across, p² L³/(12 EA) along, likewise of torsion ([Prz68] 5.6).
Eigen::VectorXd energy_error(const Mesh& mesh, const BeamElement& beam, const ElementModes& modes);

/// Corners of a solid, the first of its nodes, and the two corners between which each later node lies.
int corner_count(SolidShape shape);
inline bool is_second_order(SolidShape shape) { return node_count(shape) > corner_count(shape); }
std::array<int, 2> ends_of_edge_node(SolidShape shape, int node);

/// At a corner: of a shell the angle, of a solid the solid angle, that the element takes.
double angle_at_corner(const Mesh& mesh, const ShellElement& shell, int corner);
double angle_at_corner(const Mesh& mesh, const SolidElement& solid, int corner);

}  // namespace tisserand::reducer

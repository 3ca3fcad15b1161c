// SPDX-License-Identifier: GPL-3.0-or-later
// Geometrically exact beam elements (Simo-Reissner) with two and three nodes: constants, forces, tangents, energy.
//
// Sources: [Sim85] (strains), [CJ99] (objective interpolation of rotations),
// [Car00] section 8 (the nonlinear beam with which superelements are compared).
//
// Kinematics. Section triad Λ_i = R_i D_i of node i (columns: beam axis, y, z of the section), D_i constant.
//   Γ = Λᵀ x' − Γ₀   axial and shear strains,   κ = axial(Λᵀ Λ') − κ₀   torsion and bending, both in section axes;
//   ' is the derivative by arc length of the reference curve. Γ₀, κ₀ are the values of the same interpolation there,
//   so that a reference configuration of any curvature is free of stress.
// Axial strain: ε = Γ₁ + e(Γ) + ½ ρ² κ₁², ρ² = (E I_y + E I_z)/E A. The last term is the mean elongation of fibres that
//   twist about the axis (Wagner). It is a torsional stiffness N ρ² by the normal force N. e is zero for three nodes.
// Two nodes: ψ = log(Λ₁ᵀΛ₂), Λ(s) = Λ₁ exp(s ψ), κ = ψ/L. Strains are evaluated in the middle only, which prevents
//   shear and membrane locking. With four corrections straight beams are exact at the nodes for loads at nodes and
//   weight, and the element has order 4 if bending stays in one plane:
//   - shear stiffness 1/(1/GA + L²/(12 EI)): residual bending flexibility [Mac78] of the linear part of the moment;
//   - e = Σ (2β_k − β_k²) Γ_k²/(|v| + v₁) + β_k² Γ_k²/10, v = Γ + Γ₀, with the share β = (L²/12EI)/(1/GA + L²/12EI) of
//     bending in the shear strain. That share bends the axis by a cubic: the elongation of the axis is |v| − 1 then,
//     not v₁ − 1, and its curve is longer than its chord by a tenth of Γ_k². N gives it the stiffness N/5, where shear
//     of the section has −N. Without e the element becomes unstable at a tension of 12 EI/L²;
//   - Γ = A(ψ) Λᵀ Δx/L − Γ₀ with A = 1 − ψ~²/24: the element is the arc of its curvature, not the chord Δx;
//   - mass and weight along a parabola through the nodes that follows their sections (kernels.hpp, Parabola).
//   The remaining errors of order 2: the change of curvature κ × C_m κ along elements of bent and twisted beams (zero
//   in a plane), axial and torsional waves, shear and rotary inertia of thick beams.
// Three nodes: Φ_i = log(Λ₂ᵀΛ_i), Λ(s) = Λ₂ exp(N₁(s)Φ₁ + N₃(s)Φ₃) [CJ99]; two Gauss points.
// Both depend on relative rotations of the nodes alone. So strains do not change under a rigid motion and do not depend
// on the path. Relative rotations inside an element must stay below π.
#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

#include "formats/sections/section.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Constants of a geometrically exact beam element with N = 2 or 3 nodes. Residuals have six rows per node: force
/// (world axes), then moment (axes of the node).
template <int N>
struct BeamElement {
  static_assert(N == 2 || N == 3);
  static constexpr int dofs = 6 * N;
  static constexpr int points = N - 1;  ///< number of quadrature points

  std::array<int, N> nodes{};                 ///< indices of nodes, along the beam
  double length = 0.0;                        ///< L, arc length of the reference curve
  std::array<Eigen::Matrix3d, N> section{};   ///< D_i: section triad in node axes
  Eigen::Vector3d bending_share = {0, 0, 0};  ///< (0, β_y, β_z): shares of bending in shear strains; 0 for three nodes
  double polar_radius_squared = 0.0;          ///< ρ² = (I_y + I_z)/A, for the elongation by twist
  /// Stiffness C_n = (E A, G A_y, G A_z). With two nodes the shear stiffness contains the residual bending flexibility.
  Eigen::Vector3d force_stiffness = {0, 0, 0};
  Eigen::Vector3d moment_stiffness = {0, 0, 0};         ///< C_m = (G J, E I_y, E I_z): torsion and bending
  std::array<Eigen::Vector3d, points> initial_gamma{};  ///< Γ₀: Λᵀx' of the reference shape, (1, 0, 0) if straight
  std::array<Eigen::Vector3d, points> initial_kappa{};  ///< κ₀: curvature of the reference shape
  double mass = 0.0;                                    ///< density · A · L
  std::array<Eigen::Matrix3d, N> inertia{};             ///< rotary inertia of node i in node axes
  bool rotary = true;                                   ///< false: `inertia` is zero, and sums omit it
  /// Gravity of the body (world axes). The functions below ignore it and take gravity as an argument, which the caller
  /// has scaled.
  Eigen::Vector3d gravity = {0, 0, 0};
};

using BeamElement2 = BeamElement<2>;
using BeamElement3 = BeamElement<3>;

/// Reference geometry of a beam element in the part frame. In the reference configuration all nodes have the axes of
/// the part (R_i = 1).
template <int N>
struct BeamReference {
  std::array<int, N> nodes{};
  std::array<Eigen::Vector3d, N> position{};  ///< positions of the nodes, equally spaced in arc length
  std::array<Eigen::Matrix3d, N> section{};   ///< section triads; columns x (axis), y, z
  double length = 0.0;                        ///< arc length
};

/// Makes the constants of a beam element. Throws Error at `section.where` if the section has no shear areas, or if a
/// stiffness, the density or the length is not physical.
template <int N>
BeamElement<N> make_beam_element(const BeamReference<N>& reference, const formats::Section& section,
                                 const formats::Material& material);

/// Computes the residual r of one element: inertia force plus elastic force less weight. The elastic force is the exact
/// gradient of BeamEnergy::strain. The weight is minus the gradient of BeamEnergy::potential. `nodes`: motions of all
/// nodes of the model, of which element.nodes are indices. `gravity`: acceleration (world axes).
void residual(const BeamElement2& element, std::span<const NodeMotion> nodes, const Eigen::Vector3d& gravity,
              Eigen::Matrix<double, 12, 1>& r);
void residual(const BeamElement3& element, std::span<const NodeMotion> nodes, const Eigen::Vector3d& gravity,
              Eigen::Matrix<double, 18, 1>& r);

/// Computes the residual r and the exact tangent A = c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q of one element. The rotation
/// increments δΘ are material, δR = R skew(δΘ). Away from equilibrium A is not symmetric, because such increments are
/// not coordinates. Arguments are those of residual().
void residual_and_tangent(const BeamElement2& element, std::span<const NodeMotion> nodes,
                          const Eigen::Vector3d& gravity, const TangentCoefficients& coefficients,
                          Eigen::Matrix<double, 12, 1>& r, Eigen::Matrix<double, 12, 12>& A);
void residual_and_tangent(const BeamElement3& element, std::span<const NodeMotion> nodes,
                          const Eigen::Vector3d& gravity, const TangentCoefficients& coefficients,
                          Eigen::Matrix<double, 18, 1>& r, Eigen::Matrix<double, 18, 18>& A);

/// Kinetic, strain and gravity energy of a beam element.
struct BeamEnergy {
  double kinetic = 0.0;
  double strain = 0.0;
  double potential = 0.0;  ///< potential of gravity: −Σ m_i g · x_i
};

template <int N>
BeamEnergy energy(const BeamElement<N>& element, std::span<const NodeMotion> nodes, const Eigen::Vector3d& gravity);

/// Strains and stress resultants at one quadrature point of a beam element, in section axes. `force` and `moment` act
/// on the part of the beam on the negative side of the section, so tension is positive. With two nodes the shear
/// strains contain the residual bending of the element. The shear forces do not.
struct BeamSectionForces {
  double arc_length = 0.0;       ///< arc length from the first node of the element
  Eigen::Matrix3d axes;          ///< Λ: section triad in world axes
  Eigen::Vector3d gamma, kappa;  ///< Γ: axial and shear strains; κ: twist and curvatures
  Eigen::Vector3d force;         ///< (normal force, shear y, shear z)
  Eigen::Vector3d moment;        ///< (torque, bending about y, bending about z)
};

template <int N>
std::array<BeamSectionForces, N - 1> section_forces(const BeamElement<N>& element, std::span<const NodeMotion> nodes);

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia of elements in a turning frame: motion of their mass at first and at second order, and the resulting
// quadratic forms (formats/COMPANION.md).
//
// A point of mass moves with u = U d and turns by θ = Θ d for the coordinates d of its element. With the rotation
// exp(θ) its angular velocity in axes of the mass is THEORY (84),
//   Ω + θ̇ + Ω × θ − ½ θ × (θ̇ + Ω × θ).
// Rotary inertia J adds the squares of the first three terms to the energy, and the terms of second order THEORY (85)
//   T: ½ (J Ω)·(θ × (θ × Ω)),  W: −½ (J Ω)·(θ × θ̇).
// At second order, with the nodes held, the point moves by the turn ω of its element minus the linear motion,
//   u₂ = ω × (u − ½ ω × X) − U₂,  θ₂ = ½ ω × θ − Θ₂,
// U₂ and Θ₂ interpolated from ω × (u_i − ½ ω × X_i) and ½ ω × ψ_i of the nodes. Arms r from nodes to ends that turn by
// φ = ψ − ω against the element add ½ φ × (φ × r). A centre of mass at c adds ½ θ × (θ × c). So the momentum of a
// turned shape is the turned momentum of the shape, THEORY (86), for every element.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Three rows over the coordinates of an element.
using ElementRows3 = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Mass that moves with a point of an element, part axes.
struct MassPoint {
  ElementRows3 displacement;                          ///< U
  ElementRows3 rotation;                              ///< Θ
  Eigen::Vector3d at = Eigen::Vector3d::Zero();       ///< the point
  double mass = 0.0;                                  ///< may be zero
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< centre of mass, from the point
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre of mass
};

/// Rotary inertia that turns by Θ d.
struct RotaryMass {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  ElementRows3 rotation;
};

/// Mass of one element or point mass with six coordinates per node.
struct MovingMass {
  int coordinates = 0;
  std::vector<MassPoint> points;
  std::vector<RotaryMass> rotary;  ///< few terms with the same Σ ΘᵀJΘ as all points
  ElementRows3 turn;               ///< ω; no columns: a point mass, which is rigid
  Eigen::Matrix3Xd nodes;          ///< X_i
  Eigen::Matrix3Xd arms;           ///< r_i
};

MovingMass moving_mass(const Mesh& mesh, const BeamElement& beam);
MovingMass moving_mass(const Mesh& mesh, const ShellElement& shell);
MovingMass moving_mass(const Mesh& mesh, const NodalMass& mass);

/// Number of loads on a mass: six accelerations D_1..6 of the rigid part, and the centrifugal ones of pairs jk, −½
/// ([e_k ×] M D_3+j + [e_j ×] M D_3+k) of THEORY (94).
inline constexpr int inertial_loads = 12;

/// Forms of a rotation θ = Θ d: θ̇ᵀ C_k θ, ½ θᵀ E_jk θ, ..., with the items of TurningForms.
struct TurningPivot {
  enum Item { C = 0, E = 3, work = 9, W = 21, items = 24 };  ///< index of the first of each in `form`
  ElementRows3 rotation;
  std::array<Eigen::Matrix3d, items> form;
  unsigned present = 0;  ///< bit i: form[i] is set

  void add(int item, const Eigen::Matrix3d& matrix);
};

/// Contribution of an element, over its n coordinates.
struct TurningMass {
  Eigen::MatrixXd translation;  ///< 3 r x n: x of r masses, then y and z
  Eigen::MatrixXd momentum;     ///< `translation` times the masses
  ElementRows3 turn;            ///< ω; no columns: no turn
  Eigen::MatrixXd turned;       ///< 3 x n for each load: its work on the second order is ω·(turned d)
  std::vector<TurningPivot> pivots;
  Eigen::MatrixXd load;  ///< n x 12: loads on the nodes
};

/// Forms as whole matrices.
struct TurningForms {
  std::array<Eigen::MatrixXd, 3> C;  ///< ḋᵀ C_k d: Σ m u̇·(e_k × u) + θ̇·J (e_k × θ)
  std::array<Eigen::MatrixXd, 6> E;  ///< symmetric
  std::array<Eigen::MatrixXd, 6> N;  ///< ½ dᵀ N_a d: work of the load a on the second-order motion, nodes held
  std::array<Eigen::MatrixXd, 6> T;  ///< ½ dᵀ T_jk d: likewise for centrifugal loads, plus rotary inertia
  std::array<Eigen::MatrixXd, 3> W;  ///< antisymmetric: ḋᵀ W_k d = −½ Σ (J e_k)·(θ × θ̇)

  explicit TurningForms(Eigen::Index n);
  Eigen::MatrixXd& of(int item);  ///< matrix of a TurningPivot::Item
};

/// Adds C and E of translations to `forms`: Σ m u_a u_bᵀ as product(a, b), a ≤ b in the order xx xy xz yy yz zz.
void add_translations(const std::array<Eigen::MatrixXd, 6>& product, TurningForms& forms);

/// Computes the contribution of `mass`; D turns about the point `reference`.
void turning_mass(const MovingMass& mass, const Eigen::Vector3d& reference, TurningMass& out);

/// Computes it for an element with equal mass in all directions, from its mass matrix (three coordinates per node). `D`
/// holds the rows of its coordinates. No mass moves while the nodes are held.
void turning_mass(const Eigen::MatrixXd& M, const Eigen::MatrixXd& D, TurningMass& out);

/// Matrix of second derivatives by θ of f·½ θ × (θ × c).
Eigen::Matrix3d arm_form(const Eigen::Vector3d& f, const Eigen::Vector3d& c);

}  // namespace tisserand::reducer

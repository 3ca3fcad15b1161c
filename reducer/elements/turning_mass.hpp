// Inertia of elements in a turning frame: where their mass is, how it moves at first and at second order, and the
// quadratic forms that follow (formats/COMPANION.md).
//
// A point of mass moves with u = U d and turns by θ = Θ d for the coordinates d of its element. With the rotation
// exp(θ) the angular velocity in axes of the mass is
//   Ω + θ̇ + Ω × θ − ½ θ × (θ̇ + Ω × θ),
// so that rotary inertia J adds to the energy of the first three terms, squared, the terms of second order
//   T: ½ (J Ω)·(θ × (θ × Ω)),  W: −½ (J Ω)·(θ × θ̇).
// At second order, with the nodes held, the point moves by what a turn ω of its element leaves of the linear motion,
//   u₂ = ω × (u − ½ ω × X) − U₂,  θ₂ = ½ ω × θ − Θ₂,
// U₂ and Θ₂ interpolated from ω × (u_i − ½ ω × X_i) and ½ ω × ψ_i of the nodes; by ½ φ × (φ × r) of arms r from nodes
// to ends that turn by φ = ψ − ω against the element; and by ½ θ × (θ × c) where its mass is c beside it. So the
// momentum of a turned shape is the turned momentum of the shape, for every element.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Rows of three for the coordinates of an element.
using ElementRows3 = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Mass that moves with a point of an element, part axes.
struct MassPoint {
  ElementRows3 displacement;                          ///< U
  ElementRows3 rotation;                              ///< Θ
  Eigen::Vector3d at = Eigen::Vector3d::Zero();       ///< the point
  double mass = 0.0;                                  ///< may be zero
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< of mass, from the point
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre of mass
};

/// Rotary inertia that turns by Θ d.
struct RotaryMass {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  ElementRows3 rotation;
};

/// The mass of one element or point mass with six coordinates per node.
struct MovingMass {
  int coordinates = 0;
  std::vector<MassPoint> points;
  std::vector<RotaryMass> rotary;  ///< Σ ΘᵀJΘ of all points once more, by as few as there are
  ElementRows3 turn;               ///< ω; no columns: a point mass, which is all rigid
  Eigen::Matrix3Xd nodes;          ///< X_i
  Eigen::Matrix3Xd arms;           ///< r_i
};

MovingMass moving_mass(const Mesh& mesh, const BeamElement& beam);
MovingMass moving_mass(const Mesh& mesh, const ShellElement& shell);
MovingMass moving_mass(const Mesh& mesh, const NodalMass& mass);

/// Loads on a mass: six accelerations D_1..6 of the rigid part, and the centrifugal ones of pairs jk,
/// −½ ([e_k ×] M D_3+j + [e_j ×] M D_3+k).
inline constexpr int inertial_loads = 12;

/// Forms of a rotation θ = Θ d: θ̇ᵀ C_k θ, ½ θᵀ E_jk θ ..., as of TurningForms.
struct TurningPivot {
  enum Item { C = 0, E = 3, work = 9, W = 21, items = 24 };  ///< where each begins in `form`
  ElementRows3 rotation;
  std::array<Eigen::Matrix3d, items> form;
  unsigned present = 0;  ///< bit i: form[i] is there, the others are not set

  void add(int item, const Eigen::Matrix3d& matrix);
};

/// What an element adds, over its n coordinates.
struct TurningMass {
  Eigen::MatrixXd translation;  ///< 3 r x n: x of r masses, then y and z
  Eigen::MatrixXd momentum;     ///< the same times their masses
  ElementRows3 turn;            ///< ω; without columns: none
  Eigen::MatrixXd turned;       ///< 3 x n for each load: its work on the second order is ω·(turned d)
  std::vector<TurningPivot> pivots;
  Eigen::MatrixXd load;  ///< n x 12: of the loads, on the nodes
};

/// The same as whole matrices.
struct TurningForms {
  std::array<Eigen::MatrixXd, 3> C;  ///< ḋᵀ C_k d: Σ m u̇·(e_k × u) + θ̇·J (e_k × θ)
  std::array<Eigen::MatrixXd, 6> E;  ///< symmetric
  std::array<Eigen::MatrixXd, 6> N;  ///< ½ dᵀ N_a d: work of the load a on the second-order motion, nodes held
  std::array<Eigen::MatrixXd, 6> T;  ///< the same of centrifugal loads, and the second order of rotary inertia
  std::array<Eigen::MatrixXd, 3> W;  ///< antisymmetric: ḋᵀ W_k d = −½ Σ (J e_k)·(θ × θ̇)

  explicit TurningForms(Eigen::Index n);
  Eigen::MatrixXd& of(int item);  ///< TurningPivot::Item
};

/// C and E of translations: Σ m u_a u_bᵀ as product(a, b), a ≤ b in the order xx xy xz yy yz zz, added to `forms`.
void add_translations(const std::array<Eigen::MatrixXd, 6>& product, TurningForms& forms);

/// `reference`: the point about which D turns.
void turning_mass(const MovingMass& mass, const Eigen::Vector3d& reference, TurningMass& out);

/// Of an element whose mass moves alike in all directions, from its mass matrix (three coordinates per node); `D`: rows
/// of its coordinates. Nothing moves while the nodes are held.
void turning_mass(const Eigen::MatrixXd& M, const Eigen::MatrixXd& D, TurningMass& out);

/// Second derivative by θ of f·½ θ × (θ × c).
Eigen::Matrix3d arm_form(const Eigen::Vector3d& f, const Eigen::Vector3d& c);

}  // namespace tisserand::reducer

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

/// Matrix that gives a vector for the coordinates d of an element (3 x coordinates).
using ElementRows3 = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Mass that moves and turns with a point of an element: displacement u = U d and rotation θ = Θ d for the coordinates
/// d of the element, in part axes.
struct MassPoint {
  ElementRows3 displacement;                          ///< U: 3 x coordinates
  ElementRows3 rotation;                              ///< Θ: 3 x coordinates
  Eigen::Vector3d at = Eigen::Vector3d::Zero();       ///< position of the point
  double mass = 0.0;                                  ///< mass; may be zero
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< vector from the point to the centre of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< inertia about the centre of mass
};

/// Rotary inertia that turns by θ = Θ d for the coordinates d of an element; `rotation` is Θ.
struct RotaryMass {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  ElementRows3 rotation;
};

/// Mass of one element, or of one point mass, as points that move with its coordinates d (six per node).
struct MovingMass {
  int coordinates = 0;
  std::vector<MassPoint> points;
  std::vector<RotaryMass> rotary;  ///< few rotary inertias, whose Σ ΘᵀJΘ is that of all points
  ElementRows3 turn;               ///< rotation of the element, ω = `turn` d; no columns: a point mass, which is rigid
  Eigen::Matrix3Xd nodes;          ///< positions X_i of the nodes
  Eigen::Matrix3Xd arms;           ///< rigid arms r_i from the nodes to the ends of the element
};

MovingMass moving_mass(const Mesh& mesh, const BeamElement& beam);
MovingMass moving_mass(const Mesh& mesh, const ShellElement& shell);
MovingMass moving_mass(const Mesh& mesh, const NodalMass& mass);

/// Number of inertia loads on a mass, THEORY (94): six M D_a of rigid accelerations, then six centrifugal ones of the
/// axis pairs jk, −½ ([e_k ×] M D_3+j + [e_j ×] M D_3+k).
inline constexpr int inertial_loads = 12;

/// Bilinear forms of one rotation θ = Θ d of an element, as 3 x 3 matrices: θ̇ᵀ C_k θ, ½ θᵀ E_jk θ and so on. `form`
/// holds the items of TurningForms in the order of `Item`; `rotation` is Θ.
struct TurningPivot {
  /// Index in `form` of the first matrix of each kind; `work` stands for N, then T.
  enum Item { C = 0, E = 3, work = 9, W = 21, items = 24 };
  ElementRows3 rotation;
  std::array<Eigen::Matrix3d, items> form;
  unsigned present = 0;  ///< bit i is 1 if form[i] is set

  void add(int item, const Eigen::Matrix3d& matrix);
};

/// Contribution of one element to TurningForms and to the inertia loads, over its n coordinates d.
struct TurningMass {
  Eigen::MatrixXd translation;  ///< 3 r x n: displacements x of r masses, then y, then z
  Eigen::MatrixXd momentum;     ///< 3 r x n: `translation` times the masses
  ElementRows3 turn;            ///< rotation of the element, ω = `turn` d; no columns: none
  /// (3 · 12) x n: work of load l on the second-order motion is ω·(rows 3 l to 3 l + 2 times d).
  Eigen::MatrixXd turned;
  std::vector<TurningPivot> pivots;
  Eigen::MatrixXd load;  ///< n x 12: inertia loads on the nodes
};

/// Bilinear forms of the inertia of a turning body, as n x n matrices over coordinates d. Masses m move by u and turn
/// by θ with inertia J; e_k are unit vectors.
struct TurningForms {
  std::array<Eigen::MatrixXd, 3> C;  ///< ḋᵀ C_k d: Σ m u̇·(e_k × u) + θ̇·J (e_k × θ)
  std::array<Eigen::MatrixXd, 6> E;  ///< E_jk of THEORY (81), symmetric
  /// ½ dᵀ N_a d is the work of load a on the second-order motion while the nodes are held.
  std::array<Eigen::MatrixXd, 6> N;
  /// ½ dᵀ T_jk d is the work of the centrifugal load jk on the second-order motion while the nodes are held, plus the
  /// term of rotary inertia.
  std::array<Eigen::MatrixXd, 6> T;
  std::array<Eigen::MatrixXd, 3> W;  ///< antisymmetric: ḋᵀ W_k d = −½ Σ (J e_k)·(θ × θ̇)

  explicit TurningForms(Eigen::Index n);
  Eigen::MatrixXd& of(int item);  ///< matrix of a TurningPivot::Item
};

/// Adds the terms of translations to C and E of `forms`. `product`: Σ m u_a u_bᵀ for a ≤ b, in the order xx xy xz yy
/// yz zz.
void add_translations(const std::array<Eigen::MatrixXd, 6>& product, TurningForms& forms);

/// Computes the contribution `out` of `mass` to the forms and loads. `reference`: point about which the rigid
/// rotations D of the loads turn.
void turning_mass(const MovingMass& mass, const Eigen::Vector3d& reference, TurningMass& out);

/// Computes the contribution `out` of an element with equal mass in all directions (three coordinates per node). `M`:
/// mass matrix of the element. `D`: rows of the rigid motions for its coordinates. No mass of such an element moves
/// while its nodes are held.
void turning_mass(const Eigen::MatrixXd& M, const Eigen::MatrixXd& D, TurningMass& out);

/// Matrix of second derivatives by θ of the work f·½ θ × (θ × c), which a force f does on the second-order motion of
/// an arm c (3 x 3, symmetric).
Eigen::Matrix3d arm_form(const Eigen::Vector3d& f, const Eigen::Vector3d& c);

}  // namespace tisserand::reducer

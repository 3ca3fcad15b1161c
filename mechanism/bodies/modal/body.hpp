// SPDX-License-Identifier: GPL-3.0-or-later
// Modal body: floating frame with lumped masses and modes. Constants of a body; residual, tangent and energy at one
// instant.
//
// [GA00] (1)-(16), corrected and completed: mass matrix (8) and (16) with J = −Σ m b~ b~ + Σ μ, quadratic velocity
// terms (12) with the gyroscopic part − ω~ Σ μ (ω + θ̇). The source omits this part, which does no work. Velocities are
// [ṙ world; ω body axes; ẇ]. Sums over the nodes are computed once, so that an evaluation costs as much as 9 m²
// products.
#pragma once

#include <string>

#include <Eigen/Core>

#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Constants of a modal body: sums over its nodes k with masses m_k, inertias μ_k, positions x_k and rows Xd_k, Xt_k
/// (3 x m) of the modes. Positions are in axes of the frame. Modes are mass-normalised, so the modal coordinates w have
/// the unit √mass length.
struct ModalBody {
  std::string name;
  int node = 0;                                  ///< node of the frame (r, A), at the centre of mass
  int modes = 0;                                 ///< m: number of modes
  int offset = 0;                                ///< index of its first w in State::w
  double mass = 0.0;                             ///< Σ m_k: mass
  Eigen::Vector3d c0 = Eigen::Vector3d::Zero();  ///< Σ m_k x_k
  Eigen::Matrix3Xd C1;                           ///< Σ m_k Xd_k
  Eigen::Matrix3d P0 = Eigen::Matrix3d::Zero();  ///< Σ m_k x_k x_kᵀ
  /// Sums Σ m_k x_k Xd_kjᵀ of each mode j (9 m), column by column. Planar bodies have two numbers of each, trace and
  /// spin xy − yx (2 m), which suffice for rotations in the plane. P2 has such blocks too, and so have S, Sd, Sdd and D
  /// of ModalScratch.
  Eigen::VectorXd P1;
  Eigen::MatrixXd P2;                                  ///< (9 m x m): column i holds Σ m_k Xd_ki Xd_kjᵀ for each j
  Eigen::Matrix3d J_mu = Eigen::Matrix3d::Zero();      ///< Σ μ_k
  Eigen::Matrix3Xd N_mu;                               ///< Σ μ_k Xt_k
  Eigen::VectorXd stiffness;                           ///< (m): ω_j²
  Eigen::VectorXd damping;                             ///< 2 ζ_j ω_j + mass- and stiffness-proportional parts
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();   ///< gravity of the body; the functions below take it as argument
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< axes of the frame in axes of the part
  bool planar = false;                                 ///< result of make_planar(), with sums of the plane
  /// Matrix of planar bodies from their w to that of the spatial body (modes in space x m), with orthonormal columns.
  /// It may have no columns.
  Eigen::MatrixXd lift;

  int modes_in_space() const { return planar ? static_cast<int>(lift.rows()) : modes; }
};

/// Quantities of a modal body at one instant that residual() and tangent() share, allocated once. m is the number of
/// modes. Vectors without other note are in axes of the frame.
struct ModalScratch {
  Eigen::Vector3d om, omd;  ///< ω, ω̇ of the frame
  Eigen::Vector3d ga;       ///< Aᵀ (r̈ − gravity): acceleration less gravity
  Eigen::Vector3d c, cd;    ///< c0 + C1 w and its rate
  Eigen::Matrix3d A;        ///< rotation of the frame
  Eigen::Matrix3d J;        ///< inertia about the frame's origin
  Eigen::Matrix3Xd N;       ///< coupling of ω and ẇ: vee(S_j) + N_mu_j
  Eigen::VectorXd w, wd, wdd;
  Eigen::VectorXd S, Sd, Sdd;  ///< (9 m): S_j = P1_j + Σ_i w_i P2_ij; Σ_i ẇ_i P2_ij; Σ_i ẅ_i P2_ij
  Eigen::VectorXd D;           ///< (9): Σ ẇ_j S_j
  Eigen::VectorXd r;           ///< (6 + m): result of residual()
  Eigen::MatrixXd tangent;     ///< ((6 + m) x (6 + m)): result of tangent()
};

/// Kinetic, strain and gravity energy of a modal body.
struct ModalEnergy {
  double kinetic = 0.0;
  double strain = 0.0;
  double potential = 0.0;
};

ModalScratch make_scratch(const ModalBody& body);

/// Pointers to the m modal coordinates w of a body and to their first and second time derivatives.
struct ModalCoordinates {
  const double* w;
  const double* wd;
  const double* wdd;
};

/// Computes the quantities of ModalScratch that residual(), tangent() and energy() need. `frame`: motion of the node of
/// the body. `gravity`: acceleration (world axes).
void update_kinematics(const ModalBody& body, const NodeMotion& frame, const ModalCoordinates& modes,
                       const Eigen::Vector3d& gravity, ModalScratch& scratch);

/// Computes the residual scratch.r = M v̇ − s − g + K w + D ẇ: inertia with quadratic velocity terms s, less weight g,
/// plus stiffness and damping of the modes. Rows are [force world; moment body axes; modes]. Requires
/// update_kinematics().
void residual(const ModalBody& body, ModalScratch& scratch);

/// Computes the exact tangent scratch.tangent = c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q. Requires update_kinematics().
void tangent(const ModalBody& body, const TangentCoefficients& coefficients, ModalScratch& scratch);

/// Energies of the modal body. The potential is −gravity·(mass r + A c) with the position r and the axes A of the
/// frame. Requires update_kinematics().
ModalEnergy energy(const ModalBody& body, const NodeMotion& frame, const Eigen::Vector3d& gravity,
                   const ModalScratch& scratch);

}  // namespace tisserand::mechanism

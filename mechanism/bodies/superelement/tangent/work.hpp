// SPDX-License-Identifier: GPL-3.0-or-later
// Data that one use of a superelement body keeps between residual, tangent and solution, and work matrices.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/superelement/constants/body.hpp"
#include "mechanism/bodies/superelement/forces/residual.hpp"
#include "mechanism/bodies/superelement/tangent/internal_factor.hpp"

namespace tisserand::mechanism {

/// Matrices in the coordinates (x₀, Θ₀, y_B, y_I), of which N = nb + m are y; allocated if the body has second-order
/// terms.
struct SecondOrderWork {
  Eigen::MatrixXd K;         ///< (6 + N)², lower triangle
  Eigen::MatrixXd bent;      ///< rows x N: L + h
  Eigen::MatrixXd X;         ///< N x 6
  Eigen::MatrixXd D;         ///< 6 x N: J₀⁻¹ `momentum`
  Eigen::MatrixXd momentum;  ///< 6 x N: ∂n₂/∂ẏ, the rows yᵀ N_a, for rotations plus yᵀ W_jᵀ
  Eigen::MatrixXd K_bb;      ///< (6 + nb)²: boundary part, internal coordinates eliminated
  Eigen::MatrixXd K_Ib;      ///< m x (6 + nb)
  Eigen::MatrixXd half;      ///< (6 + nb) x nb: K_bb Z
  Eigen::MatrixXd turned;    ///< nb x (6 + nb)
  Eigen::MatrixXd pulled;    ///< nb x nb: Zᵀ K_bb Z
  Eigen::MatrixXd A_IB;      ///< m x nb
  Eigen::MatrixXd thin_boundary, thin_nodes, thin_internal;  ///< (6 + nb) x 6, nb x 6, m x 6
  Eigen::Matrix<double, 3, Eigen::Dynamic> dm, dc;           ///< 3 x nb
};

/// Transposed rows of the centre of mass (center_tangent.hpp), nb x 3 each.
struct CenterWork {
  Eigen::Matrix<double, Eigen::Dynamic, 3> w;  ///< W Γᵀ
  Eigen::Matrix<double, Eigen::Dynamic, 3> g;  ///< (Γ P)ᵀ
  Eigen::Matrix<double, Eigen::Dynamic, 3> z;  ///< (Γ (Z − c_m P))ᵀ
  Eigen::Matrix<double, Eigen::Dynamic, 3> J;
  Eigen::Matrix<double, Eigen::Dynamic, 3> F;  ///< (c_m J + c_c A_v)ᵀ
};

/// Constants of the elimination of y_I for the latest coefficients, and work matrices. All uses of a body share them,
/// so that they stay in the caches.
struct SuperelementWork {
  TangentCoefficients coefficients;  ///< coefficients of D, Q, N
  bool constants_valid = false;
  InternalFactor internal;     ///< A_II: the diagonal D = c_m + c_c D_II + c_k S_II, or full with full damping
  Eigen::MatrixXd Q;           ///< nb x nb: M_BI D⁻¹ M_IB
  Eigen::MatrixXd N;           ///< nb x nb: M_BB − c_m Q
  Eigen::MatrixXd K;           ///< nb x nb: c_k S_BB + c_c D_BB, only with a full damping matrix
  Eigen::MatrixXd A_II;        ///< m x m, only with a full damping matrix
  Eigen::MatrixXd eliminated;  ///< m x nb: A_II⁻¹ A_IB, only if the coupling is stored

  Eigen::MatrixXd A_BB;           ///< nb x nb, y_I eliminated: result of tangent()
  Eigen::VectorXd r_B_condensed;  ///< r_B − A_BI A_II⁻¹ r_I: result of condense()

  /// Scratch of the step tangent, nb x nb and nb x 3. The names are those of the formula at condensed_tangent
  /// (tangent.cpp).
  Eigen::MatrixXd Np, G1, G2;
  Eigen::Matrix<double, Eigen::Dynamic, 3> J, F, V1;
  CenterWork center;                ///< for inertia option M
  Eigen::MatrixXd planar_columns;   ///< nb x 16, for planar bodies
  Eigen::VectorXd column, turned;   ///< nb: a column of M_BI or Γᵀ, before and after a product
  Eigen::VectorXd internal_column;  ///< m

  SecondOrderWork second;
};

/// The state at which the latest tangent of one use was formed, for condense() and expand().
struct SuperelementTangent {
  TangentCoefficients coefficients;
  InternalFactor internal;  ///< factors of A_II
  Eigen::Matrix3d R0;
  Eigen::Vector3d Omega0;
  std::vector<LocalNode<double>> node;
  Eigen::Matrix<double, 3, Eigen::Dynamic> U;  ///< 3 x nb, U P⁻¹: columns in axes of the frame; not for planar bodies

  bool dense_coupling =
      false;  ///< A_BI and A_IB are stored (exact tangent, inertia M, full damping) instead of W M_BI and M_IB Z
  Eigen::MatrixXd A_BI;  ///< nb x m
  Eigen::MatrixXd A_IB;  ///< m x nb
};

/// Scratch of one use, allocated once.
struct SuperelementScratch {
  LocalMotion<double> motion;         ///< current x₀, R₀, Ω₀, y (update_kinematics)
  Eigen::Matrix3d R0_reference;       ///< the argument of update_kinematics
  SuperelementForces<double> forces;  ///< r_B, r_I (residual)
  SuperelementTangent tangent;
};

SuperelementScratch make_scratch(const SuperelementBody& body);
SuperelementWork make_work(const SuperelementBody& body);

}  // namespace tisserand::mechanism

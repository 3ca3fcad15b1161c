// SPDX-License-Identifier: GPL-3.0-or-later
// Data that one use of a superelement body keeps between residual, tangent and solution, and work matrices.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/superelement/constants/body.hpp"
#include "mechanism/bodies/superelement/forces/residual.hpp"
#include "mechanism/bodies/superelement/tangent/internal_factor.hpp"

namespace tisserand::mechanism {

/// Work matrices of bodies with second-order terms, in the coordinates (x₀, Θ₀, y_B, y_I). nb and m are the numbers of
/// y_B and y_I, N = nb + m. Z = [A₀; U; Υ], THEORY (54), leads from nodes to (x₀, Θ₀, y_B).
struct SecondOrderWork {
  Eigen::MatrixXd K;     ///< ((6 + N) x (6 + N)): tangent, lower triangle
  Eigen::MatrixXd bent;  ///< (rows x N): L + h of THEORY (44)
  Eigen::MatrixXd X;     ///< (N x 6)
  Eigen::MatrixXd D;     ///< (6 x N): J₀⁻¹ `momentum`
  /// Derivative ∂n₂/∂ẏ (6 x N) of THEORY (47): rows yᵀ N_a, for rotations plus yᵀ W_jᵀ.
  Eigen::MatrixXd momentum;
  Eigen::MatrixXd K_bb;                                      ///< ((6 + nb) x (6 + nb)): K with y_I eliminated
  Eigen::MatrixXd K_Ib;                                      ///< (m x (6 + nb))
  Eigen::MatrixXd half;                                      ///< ((6 + nb) x nb): K_bb Z
  Eigen::MatrixXd turned;                                    ///< (nb x (6 + nb))
  Eigen::MatrixXd pulled;                                    ///< (nb x nb): Zᵀ K_bb Z
  Eigen::MatrixXd A_IB;                                      ///< (m x nb)
  Eigen::MatrixXd thin_boundary, thin_nodes, thin_internal;  ///< ((6 + nb) x 6, nb x 6, m x 6)
  Eigen::Matrix<double, 3, Eigen::Dynamic> dm, dc;           ///< (3 x nb)
};

/// Matrices of the centre of mass for inertia option M (nb x 3 each), with the symbols of center_tangent.hpp. They are
/// transposed: one column per axis.
struct CenterWork {
  Eigen::Matrix<double, Eigen::Dynamic, 3> w;  ///< W Γᵀ
  Eigen::Matrix<double, Eigen::Dynamic, 3> g;  ///< (Γ P)ᵀ
  Eigen::Matrix<double, Eigen::Dynamic, 3> z;  ///< (Γ (Z − c_m P))ᵀ
  Eigen::Matrix<double, Eigen::Dynamic, 3> J;
  Eigen::Matrix<double, Eigen::Dynamic, 3> F;  ///< (c_m J + c_c A_v)ᵀ
};

/// Constants of the elimination of y_I for the latest coefficients, and work matrices. All uses of a body share one
/// SuperelementWork, so that it stays in the caches. nb and m are the numbers of boundary and internal coordinates.
struct SuperelementWork {
  TangentCoefficients coefficients;  ///< coefficients of `internal`, Q and N
  bool constants_valid = false;
  /// Factors of A_II = c_m + c_c D_II + c_k S_II: a diagonal D, or full with a full damping matrix.
  InternalFactor internal;
  Eigen::MatrixXd Q;           ///< (nb x nb): M_BI D⁻¹ M_IB
  Eigen::MatrixXd N;           ///< (nb x nb): M_BB − c_m Q
  Eigen::MatrixXd K;           ///< (nb x nb): c_k S_BB + c_c D_BB, only with full damping
  Eigen::MatrixXd A_II;        ///< (m x m), only with full damping
  Eigen::MatrixXd eliminated;  ///< (m x nb): A_II⁻¹ A_IB, only if A_IB is stored

  Eigen::MatrixXd A_BB;           ///< (nb x nb): result of tangent(), y_I eliminated
  Eigen::VectorXd r_B_condensed;  ///< (nb): r_B − A_BI A_II⁻¹ r_I, result of condense()

  /// Scratch of the step tangent (nb x nb; J, F, V1: nb x 3). The names are those of the formula at condensed_tangent
  /// (tangent.cpp).
  Eigen::MatrixXd Np, G1, G2;
  Eigen::Matrix<double, Eigen::Dynamic, 3> J, F, V1;
  CenterWork center;                ///< for inertia option M
  Eigen::MatrixXd planar_columns;   ///< (nb x 16), for planar bodies
  Eigen::VectorXd column, turned;   ///< (nb): a column of M_BI or Γᵀ, before and after a product
  Eigen::VectorXd internal_column;  ///< (m)

  SecondOrderWork second;
};

/// State at which the latest tangent of one use was formed, and its coupling blocks, for condense() and expand(). nb
/// and m are the numbers of boundary and internal coordinates.
struct SuperelementTangent {
  TangentCoefficients coefficients;
  InternalFactor internal;  ///< factors of A_II
  Eigen::Matrix3d R0;
  Eigen::Vector3d Omega0;
  std::vector<LocalNode<double>> node;
  /// U P⁻¹ (3 x nb), columns in axes of the frame. It is not set for planar bodies.
  Eigen::Matrix<double, 3, Eigen::Dynamic> U;

  /// Whether A_BI and A_IB are stored instead of W M_BI and M_IB Z. They are stored for exact tangents, planar bodies,
  /// inertia option M, full damping and second-order terms.
  bool dense_coupling = false;
  Eigen::MatrixXd A_BI;  ///< (nb x m)
  Eigen::MatrixXd A_IB;  ///< (m x nb)
};

/// Scratch of one use of a superelement body, allocated once: its motion, forces and latest tangent.
struct SuperelementScratch {
  LocalMotion<double> motion;         ///< x₀, R₀, Ω₀, y: result of update_kinematics()
  Eigen::Matrix3d R0_reference;       ///< argument of the last update_kinematics()
  SuperelementForces<double> forces;  ///< r_B, r_I: result of residual()
  SuperelementTangent tangent;
};

SuperelementScratch make_scratch(const SuperelementBody& body);
SuperelementWork make_work(const SuperelementBody& body);

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Tangents of a superelement body (step tangent, with internal coordinates kept, exact) and elimination of y_I.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/tangent/work.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Step tangent after residual(), THEORY (31), (20), (38): work.A_BB = A_BB − W Q Z with the boundary part of
///   c_m Pᵀ M̄ P + c_c (C₁ + C₂ + C₃ + Υᵀ D Υ) + c_k Υᵀ S̄ Υ          ([Car00] (31), (49)-(51), (61)-(63), corrected),
/// and the data of condense() and expand(). Derivatives of Υ, U and the weight are omitted. The elimination of y_I is
/// exact: C has no I-I block, so D = A_II is a constant diagonal; Q = M_BI D⁻¹ M_IB is kept for constant coefficients.
/// With a full damping matrix D is the full matrix A_II, and A_BI = W M_BI + c_c Υᵀ D_BI, A_IB = M_IB Z + c_c D_IB Υ
/// are stored.
void tangent(const SuperelementBody& body, const TangentCoefficients& coefficients, SuperelementScratch& scratch,
             SuperelementWork& work);

/// Step tangent with the internal coordinates kept: work.A_BB, and A_BI, A_IB of the tangent, whose sizes the caller
/// has set. All are linear in the coefficients. A_II is c_m + c_c D_II + c_k S_II. For bodies with second-order terms
/// it is the lower triangle of the last m rows of work.second.K. condense() and expand() need tangent() instead.
void kept_tangent(const SuperelementBody& body, const TangentCoefficients& coefficients, SuperelementScratch& scratch,
                  SuperelementWork& work);

/// Exact counterpart of tangent(): c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q by dual numbers. Allocates.
void exact_tangent(const SuperelementBody& body, const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                   const TangentCoefficients& coefficients, SuperelementScratch& scratch, SuperelementWork& work);

/// Computes work.r_B_condensed = r_B − A_BI A_II⁻¹ r_I, THEORY (38), with the blocks of the latest tangent of this use.
void condense(const SuperelementBody& body, const SuperelementScratch& scratch, SuperelementWork& work);

/// Computes dy_I = −A_II⁻¹ (r_I + A_IB dq_B), THEORY (38): the internal part of the solution of A d = −r.
void expand(const SuperelementBody& body, const SuperelementScratch& scratch, const double* dq_B, double* dy_I,
            SuperelementWork& work);

/// Computes dy_I = −A_II⁻¹ A_IB dq_B: expand() with zero residual.
void expand_motion(const SuperelementBody& body, const SuperelementScratch& scratch, const double* dq_B, double* dy_I,
                   SuperelementWork& work);

/// Exact tangent without elimination of y_I, (nb + m)². Needs residual(). Allocates.
void whole_exact_tangent(const SuperelementBody& body, const SuperelementScratch& scratch,
                         const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                         const TangentCoefficients& coefficients, Eigen::MatrixXd& A);

}  // namespace tisserand::mechanism

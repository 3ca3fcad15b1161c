// SPDX-License-Identifier: GPL-3.0-or-later
// Tangents of a superelement body (step tangent, with internal coordinates kept, exact) and elimination of y_I.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/tangent/work.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Computes the step tangent of a body with its m internal coordinates eliminated, THEORY (31), (20), (38): work.A_BB,
/// and the data that condense() and expand() need. Requires residual(). It is A_BB − W Q Z with the boundary part A_BB
/// of
/// c_m Pᵀ M̄ P + c_c (C₁ + C₂ + C₃ + Υᵀ D Υ) + c_k Υᵀ S̄ Υ ([Car00] (31), (49)-(51), (61)-(63), corrected).
/// Derivatives of Υ, U and the weight are omitted. The elimination is exact: C has no internal block, so A_II is a
/// constant diagonal, and Q = M_BI A_II⁻¹ M_IB is kept for constant coefficients. With a full damping matrix A_II is
/// full, and A_BI = W M_BI + c_c Υᵀ D_BI and A_IB = M_IB Z + c_c D_IB Υ are stored. coupling.hpp has W and Z.
void tangent(const SuperelementBody& body, const TangentCoefficients& coefficients, SuperelementScratch& scratch,
             SuperelementWork& work);

/// Computes the step tangent with internal coordinates kept: work.A_BB, and A_BI and A_IB of scratch.tangent, whose
/// sizes the caller must have set. All three are linear in the coefficients. A_II is c_m + c_c D_II + c_k S_II. For
/// bodies with second-order terms it is the lower triangle of the last m rows of work.second.K. condense() and expand()
/// require tangent() instead.
void kept_tangent(const SuperelementBody& body, const TangentCoefficients& coefficients, SuperelementScratch& scratch,
                  SuperelementWork& work);

/// Computes the exact tangent c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q by dual numbers, with internal coordinates eliminated.
/// Results are those of tangent(). Allocates memory.
void exact_tangent(const SuperelementBody& body, const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                   const TangentCoefficients& coefficients, SuperelementScratch& scratch, SuperelementWork& work);

/// Computes the condensed residual work.r_B_condensed = r_B − A_BI A_II⁻¹ r_I, THEORY (38), with the blocks of the
/// latest tangent of this use.
void condense(const SuperelementBody& body, const SuperelementScratch& scratch, SuperelementWork& work);

/// Computes the increment of the internal coordinates, dy_I = −A_II⁻¹ (r_I + A_IB dq_B), THEORY (38). It is the
/// internal part of the solution of A d = −r with the boundary part dq_B.
void expand(const SuperelementBody& body, const SuperelementScratch& scratch, const double* dq_B, double* dy_I,
            SuperelementWork& work);

/// Computes the increment of the internal coordinates for a zero residual, dy_I = −A_II⁻¹ A_IB dq_B.
void expand_motion(const SuperelementBody& body, const SuperelementScratch& scratch, const double* dq_B, double* dy_I,
                   SuperelementWork& work);

/// Computes the exact tangent A ((nb + m) x (nb + m)) without elimination of the internal coordinates, by dual numbers.
/// Requires residual(). Allocates memory.
void whole_exact_tangent(const SuperelementBody& body, const SuperelementScratch& scratch,
                         const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                         const TangentCoefficients& coefficients, Eigen::MatrixXd& A);

}  // namespace tisserand::mechanism

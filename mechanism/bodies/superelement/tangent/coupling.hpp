// SPDX-License-Identifier: GPL-3.0-or-later
// Coupling of boundary and internal coordinates in the step tangent: A_BI = W M_BI, A_IB = M_IB Z, and the terms of
// damping.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/tangent/work.hpp"

namespace tisserand::mechanism {

/// Adds factor · Υᵀ t to `out` at the state of the latest tangent. t is in local coordinates (axes of the frame), `out`
/// in those of the nodes, like r_B.
void add_upsilon_transposed(const SuperelementBody& body, const SuperelementTangent& tangent, double factor,
                            const Eigen::VectorXd& t, Eigen::VectorXd& out);

/// Computes out = Z v with Z = c_m P + c_c (O₀ᵀ P + V U), the factor of A_IB = M_IB Z. v is in coordinates of the
/// nodes, `out` in local coordinates.
void apply_Z(const SuperelementBody& body, const SuperelementTangent& tangent, const double* v, Eigen::VectorXd& out);

/// Computes out = Zᵀ t with the Z of apply_Z(). t is in local coordinates, `out` in those of the nodes.
void apply_Z_transposed(const SuperelementBody& body, const SuperelementTangent& tangent, const Eigen::VectorXd& t,
                        Eigen::VectorXd& out);

/// Computes out = W t with W = c_m Pᵀ + c_c (Pᵀ (O₀ ∓ O_B) − UᵀVᵀ), the factor of A_BI = W M_BI. O_B has − in inertia
/// option A and + otherwise. t is in local coordinates, `out` in those of the nodes.
void apply_W(const SuperelementBody& body, const SuperelementTangent& tangent, const Eigen::VectorXd& t,
             Eigen::VectorXd& out);

/// Whether the tangent stores A_BI and A_IB instead of applying W M_BI and M_IB Z.
bool has_stored_coupling(const SuperelementBody& body);

/// Stores the coupling blocks A_BI = W M_BI + c_c Υᵀ D_BI and A_IB = M_IB Z + c_c D_IB Υ in `tangent`.
void store_coupling(const SuperelementBody& body, SuperelementTangent& tangent, SuperelementWork& work);

/// Subtracts A_BI A_II⁻¹ A_IB from work.A_BB, with the blocks stored in `tangent`.
void eliminate_internal(const SuperelementTangent& tangent, SuperelementWork& work);

}  // namespace tisserand::mechanism

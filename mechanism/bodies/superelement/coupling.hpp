// The coupling of boundary and internal coordinates in the step tangent: A_BI = W M_BI, A_IB = M_IB Z.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/evaluate.hpp"

namespace tisserand::mechanism {

/// out = Υ v (boundary rows) at the state of the latest tangent. v in coordinates of r_B, out in local coordinates.
void apply_upsilon(const SuperelementBody& body, const SuperelementTangent& tangent, const double* v,
                   Eigen::VectorXd& out);

/// out = Z v, Z = c_m P + c_c (O₀ᵀ P + V U + a Υ).
void apply_Z(const SuperelementBody& body, const SuperelementTangent& tangent, const double* v, Eigen::VectorXd& out);

/// out = W t without a.
void apply_inertia_of_W(const SuperelementBody& body, const SuperelementTangent& tangent, const Eigen::VectorXd& t,
                        Eigen::VectorXd& out);

/// out = Zᵀ t.
void apply_Z_transposed(const SuperelementBody& body, const SuperelementTangent& tangent, const Eigen::VectorXd& t,
                        Eigen::VectorXd& out);

/// out = W t, W = c_m Pᵀ + c_c (Pᵀ (O₀ ∓ O_B) − UᵀVᵀ + a Υᵀ).
void apply_W(const SuperelementBody& body, const SuperelementTangent& tangent, const Eigen::VectorXd& t,
             Eigen::VectorXd& out);

}  // namespace tisserand::mechanism

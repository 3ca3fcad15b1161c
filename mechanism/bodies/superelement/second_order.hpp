// What goes beyond S̄ and M̄ in a superelement body: stiffening and full inertia, made from the arrays of a companion
// file.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/superelement/quadratic_forms.hpp"

namespace tisserand::mechanism {

struct SuperelementBody;

/// H, C, E, N, T of section 1 of [SO] on the coordinates of a body (boundary, then internal; N of them), integrals
/// about x₀ of the reference configuration, in units of the scene. Pairs jk in the order xx yy zz yz xz xy.
struct SecondOrderArrays {
  std::vector<Eigen::MatrixXd> H;    ///< N matrices: Φᵀ K_G[stress of Φⱼ] Φ
  std::array<Eigen::MatrixXd, 3> C;  ///< Φᵀ M [e_k x] Φ
  std::array<Eigen::MatrixXd, 6> E;  ///< sym ([eⱼ x] Φ)ᵀ M [e_k x] Φ
  std::array<Eigen::MatrixXd, 6> N;  ///< ½ yᵀ N_a y = D_Raᵀ M w₂
  std::array<Eigen::MatrixXd, 6> T;  ///< ½ yᵀ T_jk y = sym D_R(3+j)ᵀ M [e_k x] w₂
};

/// Strain energy as a sum of squares, V = ½ Σ e_a², e_a = l_a·y + ½ yᵀ Γ_a y: the rows L of S̄ = LᵀL, with Γ. S̄ y stays
/// what it is without stiffening; these are the terms beyond it.
struct Stiffening {
  Eigen::MatrixXd L;     ///< rows x N
  QuadraticForms Gamma;  ///< rows
};

/// T = ½ ‖Φ ξ + Ω × Φ y‖²_M with ξ = R (ν + J₀⁻¹ n₂) + ẏ, ν = (v₀, Ω).
struct FullInertia {
  Eigen::MatrixXd M;                            ///< N x N
  Eigen::Matrix<double, Eigen::Dynamic, 6> R;   ///< rigid motions in y about x₀
  Eigen::Matrix<double, Eigen::Dynamic, 6> MR;  ///< M̄ R
  Eigen::Matrix<double, 6, 6> J0_inverse;       ///< of RᵀM̄R; pseudo-inverse where an axis has no inertia
  Eigen::MatrixXd C;                            ///< 3N x N: C_x, C_y, C_z, after the Galilean step
  QuadraticForms E;                             ///< 6
  std::optional<QuadraticForms> NT;             ///< 12: N, T; absent: no foreshortening in the inertia
};

/// The terms that are on.
struct SecondOrder {
  std::optional<Stiffening> stiffening;
  std::optional<FullInertia> inertia;

  bool any() const { return stiffening.has_value() || inertia.has_value(); }
};

/// Rows of S̄ = LᵀL: eigenvectors of the scaled S̄_BB above 1e-9 of its largest eigenvalue, and ωᵢ of the internal
/// coordinates; Γ_a = Σⱼ (L⁺)_ja Hⱼ ([SO] 2.3).
Stiffening make_stiffening(const SuperelementBody& body, const std::vector<Eigen::MatrixXd>& H);

enum class Foreshortening { off, on };

/// C gets the step that makes its resultants exact under translation, C_k += (M̄ R_T/m) d_k, d_k = e_k~ S1 − R_Tᵀ C_k
/// ([SO] 2.2).
FullInertia make_full_inertia(const SuperelementBody& body, const SecondOrderArrays& arrays,
                              Foreshortening foreshortening);

}  // namespace tisserand::mechanism

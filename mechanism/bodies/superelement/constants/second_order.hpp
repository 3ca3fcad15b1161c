// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffening and full inertia of a superelement body, from the arrays of a companion file.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/math/block_columns.hpp"
#include "common/units.hpp"
#include "formats/companion/companion.hpp"
#include "formats/scene/body_spec.hpp"
#include "formats/superelement/canonical.hpp"
#include "mechanism/bodies/superelement/constants/quadratic_forms.hpp"

namespace tisserand::mechanism {

struct SuperelementBody;

/// Stiffening: terms of the strain energy as a sum of squares, THEORY (43), V = ½ Σ e_a² with e_a = l_a·y + ½ yᵀ Γ_a y.
/// The rows l_a of L factor the stiffness, S̄ = LᵀL, so these terms are additional to S̄ y. Rows that come from Λ of
/// the companion have l = 0. The last rows may be zero, as in QuadraticForms.
struct Stiffening {
  Eigen::MatrixXd L;      ///< (rows x N), N coordinates y
  BlockColumns L_blocks;  ///< L as block columns, for products
  QuadraticForms Gamma;   ///< Γ_a of all rows
  /// Sums Σ_k |l_ak| of each row (rows x 2): over translations of nodes, and over rotations.
  Eigen::Matrix<double, Eigen::Dynamic, 2> reach;
  /// Right inverse of L (N x rows): L · inverse = 1 on the non-zero rows of L. Columns of zero rows are 0.
  Eigen::MatrixXd inverse;
};

/// Constants of the kinetic energy of inertia option F, THEORY (48): T = ½ ‖Φ ξ + Ω × Φ y‖²_M with ξ = R (η + J₀⁻¹
/// n₂) + ẏ. η = (v₀, Ω) are velocity and angular velocity of the floating frame, and n₂ is the momentum of THEORY (47).
struct FullInertia {
  int boundary_size = 0;
  Eigen::MatrixXd M;                            ///< M̄ (N x N), unit matrix on the internal coordinates
  Eigen::Matrix<double, Eigen::Dynamic, 6> R;   ///< Φ₀ of THEORY: rigid motions of y about x₀
  Eigen::Matrix<double, Eigen::Dynamic, 6> MR;  ///< M̄ R
  Eigen::Matrix<double, 6, 6> J0_inverse;       ///< inverse of RᵀM̄R; pseudo-inverse if an axis has no inertia
  BlockColumns C;                               ///< (3N x N): C_x, C_y, C_z of THEORY (81)
  bool foreshortening = false;                  ///< whether N, T and W are used
  BlockColumns W;                               ///< (3N x N): W_x, W_y, W_z; empty without rotary inertia
  PairedForms forms;                            ///< six N_a, six T_jk and six E_jk, or E_jk alone

  static constexpr int all = 20, E_alone = 8;  ///< counts of `forms`, including the zeros that fill blocks
};

/// Second-order terms of a body that are active: stiffening, full inertia, both or none.
struct SecondOrder {
  std::optional<Stiffening> stiffening;
  std::optional<FullInertia> inertia;

  bool any() const { return stiffening.has_value() || inertia.has_value(); }
};

/// Companion data in the coordinates of a body that is complete except for its second-order terms. Rows have the order
/// of the body and units of the scene; the reference point is x₀. `matrices` is the canonical form of the file with all
/// modes, of which the body keeps the first. C and E are corrected to be exact under translation (formats/COMPANION.md,
/// "Operations").
formats::Companion companion_on_body(formats::Companion companion, const formats::Superelement& element,
                                     const formats::CanonicalMatrices& matrices, const UnitConversion& units,
                                     const SuperelementBody& body);

/// Makes the terms of stiffening: rows of S̄ = LᵀL, and Γ with Lᵀ Γ = H, THEORY (43). Rows of the scaled S̄_BB come
/// from a Cholesky factorisation with pivots above 1e-9 of the first, those of internal coordinates are ωᵢ. All factors
/// L of S̄ have the same energy. This L keeps separate what S̄ separates (stretch, torsion, bending in either plane of
/// a straight beam), and so does Γ. Rows Λ of the companion follow with l = 0. Rows with similar Γ are adjacent.
/// `companion`: result of companion_on_body().
Stiffening make_stiffening(const SuperelementBody& body, const formats::Companion& companion);

enum class Foreshortening { off, on };

FullInertia make_full_inertia(const SuperelementBody& body, const formats::Companion& companion,
                              Foreshortening foreshortening);

/// Makes the second-order terms that the chosen options of inertia and stiffening need.
SecondOrder make_second_order(const SuperelementBody& body, const formats::Companion& companion,
                              formats::InertiaOption inertia, formats::StiffeningOption stiffening);

}  // namespace tisserand::mechanism

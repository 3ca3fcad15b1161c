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

/// Terms of the strain energy as a sum of squares, THEORY (43): V = ½ Σ e_a², e_a = l_a·y + ½ yᵀ Γ_a y. L holds the
/// rows of S̄ = LᵀL. S̄ y is the same as without stiffening; these terms are additional. Rows Λ of the companion have
/// l = 0. The last rows may be zero, as in QuadraticForms.
struct Stiffening {
  Eigen::MatrixXd L;                               ///< rows x N
  BlockColumns L_blocks;                           ///< L in blocks
  QuadraticForms Gamma;                            ///< rows
  Eigen::Matrix<double, Eigen::Dynamic, 2> reach;  ///< rows x 2: Σ_k |l_ak| over translations of nodes, over rotations
  Eigen::MatrixXd inverse;  ///< N x rows: L · inverse = 1 on the non-zero rows of L; the other columns are 0
};

/// Arrays of the kinetic energy THEORY (48): T = ½ ‖Φ ξ + Ω × Φ y‖²_M with ξ = R (ν + J₀⁻¹ n₂) + ẏ, ν = (v₀, Ω).
struct FullInertia {
  int boundary_size = 0;
  Eigen::MatrixXd M;                            ///< N x N, unit matrix on the internal coordinates
  Eigen::Matrix<double, Eigen::Dynamic, 6> R;   ///< rigid motions in y about x₀
  Eigen::Matrix<double, Eigen::Dynamic, 6> MR;  ///< M̄ R
  Eigen::Matrix<double, 6, 6> J0_inverse;       ///< inverse of RᵀM̄R; pseudo-inverse if an axis has no inertia
  BlockColumns C;                               ///< 3N x N: C_x, C_y, C_z, after the Galilean step
  bool foreshortening = false;                  ///< whether N, T and W are used
  BlockColumns W;                               ///< 3N x N: W_x, W_y, W_z; empty without rotary inertia
  PairedForms forms;                            ///< N (6), T (6), E (6), or E alone

  static constexpr int all = 20, E_alone = 8;  ///< counts of `forms`, including the zeros that fill blocks
};

/// The active second-order terms.
struct SecondOrder {
  std::optional<Stiffening> stiffening;
  std::optional<FullInertia> inertia;

  bool any() const { return stiffening.has_value() || inertia.has_value(); }
};

/// Companion in the coordinates of a body that is complete except for its second-order terms. Rows have the order of
/// the body, units of the scene and the canonical form of `matrices` (all modes, of which the body keeps the first). x₀
/// is the reference point. C and E become exact under translation (formats/COMPANION.md, "Operations").
formats::Companion companion_on_body(formats::Companion companion, const formats::Superelement& element,
                                     const formats::CanonicalMatrices& matrices, const UnitConversion& units,
                                     const SuperelementBody& body);

/// Rows of S̄ = LᵀL: of the scaled S̄_BB by Cholesky with pivots above 1e-9 of the first, and ωᵢ of the internal
/// coordinates; Lᵀ Γ = H, THEORY (43). Any rows have the same energy. These keep separate what S̄ separates (stretch,
/// torsion, bending in either plane of a straight beam), and so does Γ. The companion's Λ follow with l = 0. Rows with
/// similar Γ are adjacent. `companion` is the result of companion_on_body().
Stiffening make_stiffening(const SuperelementBody& body, const formats::Companion& companion);

enum class Foreshortening { off, on };

FullInertia make_full_inertia(const SuperelementBody& body, const formats::Companion& companion,
                              Foreshortening foreshortening);

/// Second-order terms of the chosen options.
SecondOrder make_second_order(const SuperelementBody& body, const formats::Companion& companion,
                              formats::InertiaOption inertia, formats::StiffeningOption stiffening);

}  // namespace tisserand::mechanism

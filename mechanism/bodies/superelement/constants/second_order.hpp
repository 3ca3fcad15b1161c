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

/// Strain energy as a sum of squares, THEORY (43): V = ½ Σ e_a², e_a = l_a·y + ½ yᵀ Γ_a y: the rows L of S̄ = LᵀL, with
/// Γ. S̄ y stays what it is without stiffening; these are the terms beyond it. Rows Λ of the companion have l = 0. The
/// last rows may be zero, as those of QuadraticForms.
struct Stiffening {
  Eigen::MatrixXd L;                               ///< rows x N
  BlockColumns L_blocks;                           ///< the same
  QuadraticForms Gamma;                            ///< rows
  Eigen::Matrix<double, Eigen::Dynamic, 2> reach;  ///< rows x 2: Σ_k |l_ak| over translations of nodes, over rotations
  Eigen::MatrixXd inverse;  ///< N x rows: L · inverse = 1 on the rows in which L is not zero; the other columns are 0
};

/// Arrays of the kinetic energy THEORY (48): T = ½ ‖Φ ξ + Ω × Φ y‖²_M with ξ = R (ν + J₀⁻¹ n₂) + ẏ, ν = (v₀, Ω).
struct FullInertia {
  int boundary_size = 0;
  Eigen::MatrixXd M;                            ///< N x N, 1 on the internal coordinates
  Eigen::Matrix<double, Eigen::Dynamic, 6> R;   ///< rigid motions in y about x₀
  Eigen::Matrix<double, Eigen::Dynamic, 6> MR;  ///< M̄ R
  Eigen::Matrix<double, 6, 6> J0_inverse;       ///< of RᵀM̄R; pseudo-inverse where an axis has no inertia
  BlockColumns C;                               ///< 3N x N: C_x, C_y, C_z, after the Galilean step
  bool foreshortening = false;                  ///< whether N, T and W are on
  BlockColumns W;                               ///< 3N x N: W_x, W_y, W_z; without entries: no rotary inertia
  PairedForms forms;                            ///< N (6), T (6), E (6), or E alone

  static constexpr int all = 20, E_alone = 8;  ///< counts of `forms`, with the zeros that fill blocks
};

/// The terms that are on.
struct SecondOrder {
  std::optional<Stiffening> stiffening;
  std::optional<FullInertia> inertia;

  bool any() const { return stiffening.has_value() || inertia.has_value(); }
};

/// A companion on the coordinates of a body that has all but its second-order terms: rows in the order of the body,
/// units of the scene, canonical form of `matrices` (all of its modes, of which the body keeps the first), the
/// reference point at x₀; C and E made exact under translation (formats/COMPANION.md, "Operations").
formats::Companion companion_on_body(formats::Companion companion, const formats::Superelement& element,
                                     const formats::CanonicalMatrices& matrices, const UnitConversion& units,
                                     const SuperelementBody& body);

/// Rows of S̄ = LᵀL: of the scaled S̄_BB by Cholesky with pivots above 1e-9 of the first, and ωᵢ of the internal
/// coordinates; Lᵀ Γ = H, THEORY (43). Any rows have the same energy; these keep apart what S̄ keeps apart (stretch,
/// torsion, bending in either plane of a straight beam), and Γ with them; and the companion's Λ with l = 0. Rows of
/// like Γ follow one another. The companion is that of companion_on_body().
Stiffening make_stiffening(const SuperelementBody& body, const formats::Companion& companion);

enum class Foreshortening { off, on };

FullInertia make_full_inertia(const SuperelementBody& body, const formats::Companion& companion,
                              Foreshortening foreshortening);

/// The terms of the chosen options.
SecondOrder make_second_order(const SuperelementBody& body, const formats::Companion& companion,
                              formats::InertiaOption inertia, formats::StiffeningOption stiffening);

}  // namespace tisserand::mechanism

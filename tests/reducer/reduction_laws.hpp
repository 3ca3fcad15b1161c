// SPDX-License-Identifier: GPL-3.0-or-later
// What every Craig-Bampton reduction must have, measured on the frame of the tests: for its tests and the table of
// verification.
#pragma once

namespace tisserand::testing {

/// Over 0, 1, 4, 10, 20, 40 and all internal modes; squared frequencies λ of the first twelve elastic modes, floating.
struct RitzLaws {
  double below_full = 0.0;      ///< largest λ_full/λ - 1: not above round-off
  double growth = 0.0;          ///< largest λ/λ(fewer modes) - 1: not above round-off
  double all_modes = 0.0;       ///< largest |λ/λ_full - 1| with all modes: round-off
  double share_of_bound = 0.0;  ///< largest error over the bound λ/(λ_c - λ) of Elssel and Voss (2006), λ_c the first
                                ///< dropped; at most 1
};
RitzLaws ritz_laws();

/// Largest differences relative to the largest entry.
struct BoundaryLaws {
  double rigid_mass = 0.0;       ///< of the reduced rigid mass matrix, no modes
  double rigid_stiffness = 0.0;  ///< S̄ times rigid motions, over the largest entry of S̄
  double flexibility = 0.0;      ///< of two boundary nodes with the third held, no modes
  double effective_mass = 0.0;   ///< Σ M̄_Bkᵀ M̄_kB of all modes against Xᵀ M_II⁻¹ X, X = M_IB + M_II Ψ
};
BoundaryLaws boundary_laws();

}  // namespace tisserand::testing

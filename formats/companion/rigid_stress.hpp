// SPDX-License-Identifier: GPL-3.0-or-later
// Stress of rigid motions in the array H of a companion, which is zero except for round-off.
#pragma once

#include <string>

#include "formats/companion/companion.hpp"

namespace tisserand::formats {

/// Stress that rigid motions R cause: the size of Σ_j R_ja H_j for the arrays H of a companion, and the sizes to
/// compare it with. All are in scaled coordinates, whose unit is a length.
struct RigidStress {
  double residual = 0.0;  ///< largest entry of Σ_j R_ja H_j over all motions
  double largest = 0.0;   ///< largest entry of H
  /// s/l: geometric stiffness of a stress of the size s of the stiffness when the body moves by its length l. If all
  /// modes only bend, every entry of H is small compared with it.
  double stiffness = 0.0;
  int motion = 0;  ///< index of the motion with the largest entry: x, y, z, about x, about y, about z

  double scale() const { return largest > stiffness ? largest : stiffness; }
};

RigidStress rigid_stress(const Companion& companion, const Superelement& superelement);

/// Description of rigid motion 0 to 5: "moving in x", "turning about z".
const char* motion_text(int motion);

/// Removes the stress of rigid motions R from the arrays H: H_j −= Σ_a W_ja Σ_i R_ia H_i with RᵀW = 1. This stress is
/// round-off, which grows with thinness. Throws Error (at `where`) if it exceeds both 1e-4 of the largest entry and
/// 1e-6 of RigidStress::stiffness, which round-off does not explain.
void remove_rigid_stress(Companion& companion, const Superelement& superelement, const std::string& where);

}  // namespace tisserand::formats

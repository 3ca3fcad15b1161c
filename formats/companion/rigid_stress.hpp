// Stress of rigid motions in the array H of a companion: what round-off leaves of nothing.
#pragma once

#include <string>

#include "formats/companion/companion.hpp"

namespace tisserand::formats {

/// H R = Σ_j R_ja H_j beside what arrays of double numbers can hold. All in scaled coordinates, whose unit is a length.
struct RigidStress {
  double residual = 0.0;  ///< largest entry of Σ_j R_ja H_j of the worst motion
  double largest = 0.0;   ///< largest entry of H
  /// s/l: the geometric stiffness that a stress of the size of the stiffness s has when the body moves by its length l.
  /// Modes that only bend make every entry of H small beside it.
  double stiffness = 0.0;
  int motion = 0;  ///< the worst: x, y, z, about x, about y, about z

  double scale() const { return largest > stiffness ? largest : stiffness; }
};

RigidStress rigid_stress(const Companion& companion, const Superelement& superelement);

/// "moving in x", "turning about z".
const char* motion_text(int motion);

/// H_j −= Σ_a W_ja Σ_i R_ia H_i with RᵀW = 1: afterwards rigid motions have no stress to the last digits. By theory
/// they have none before; what is removed is round-off of stresses that grow with thinness. Throws Error (at `where`)
/// for more than 1e-4 of the largest entry and 1e-6 of s/l, which no round-off explains.
void remove_rigid_stress(Companion& companion, const Superelement& superelement, const std::string& where);

}  // namespace tisserand::formats

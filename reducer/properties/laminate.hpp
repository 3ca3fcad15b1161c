// SPDX-License-Identifier: GPL-3.0-or-later
// Sections of shells: stiffness and mass per area of an isotropic sheet or a stack of orthotropic plies.
#pragma once

#include <string>
#include <vector>

#include "reducer/properties/shell_section.hpp"

namespace tisserand::reducer {

/// Orthotropic sheet in plane stress, one layer. 1 along the fibres, 2 across them, 3 the normal of the shell.
struct Ply {
  double E1 = 0.0;
  double E2 = 0.0;
  double nu12 = 0.0;  ///< -ε2/ε1 under σ1 alone; nu21 = nu12 E2/E1
  double G12 = 0.0;
  double G13 = 0.0;
  double G23 = 0.0;
  double density = 0.0;
  double thickness = 0.0;
  double angle = 0.0;  ///< rad, from the x axis of the laminate to the fibres, right-handed about the normal
};

/// Section with A, D and As = `shear_correction` G t of a homogeneous isotropic sheet; z from its middle.
ShellSection isotropic_shell(double youngs_modulus, double poisson_ratio, double density, double thickness,
                             double shear_correction);

/// Section by classical lamination theory ([Jon99] chapter 4) about the reference surface z = 0. The first ply is the
/// lowest, from z = `bottom` up (bottom = -thickness/2: the middle). Transverse shear: equilibrium in cylindrical
/// bending along x and along y gives τ(z) = f(z) Q, and its complementary energy gives As = (∫ fᵀ G⁻¹ f dz)⁻¹ ([RR97]).
/// That is 5/6 G t for a homogeneous sheet. check_plies must accept the plies.
ShellSection laminate(const std::vector<Ply>& plies, double bottom);

/// Throws Error naming the ply and the quantity unless every ply has finite values, thickness, E1, E2, G12, G13, G23 >
/// 0, density >= 0 and nu12² < E1/E2.
void check_plies(const std::vector<Ply>& plies, const std::string& where);

}  // namespace tisserand::reducer

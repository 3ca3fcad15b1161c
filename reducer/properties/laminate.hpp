// SPDX-License-Identifier: GPL-3.0-or-later
// Sections of shells: stiffness and mass per area of an isotropic sheet or a stack of orthotropic plies.
#pragma once

#include <string>
#include <vector>

#include "reducer/properties/shell_section.hpp"

namespace tisserand::reducer {

/// Ply: one orthotropic layer of a laminate, in plane stress. Axis 1 is along the fibres, 2 across them, 3 the normal
/// of the shell.
struct Ply {
  double E1 = 0.0;
  double E2 = 0.0;
  double nu12 = 0.0;  ///< Poisson's ratio -ε2/ε1 under σ1 alone; nu21 = nu12 E2/E1
  double G12 = 0.0;
  double G13 = 0.0;
  double G23 = 0.0;
  double density = 0.0;
  double thickness = 0.0;
  double angle = 0.0;  ///< angle from the x axis of the laminate to the fibres [rad], right-handed about the normal
};

/// Section of a homogeneous isotropic shell, with A, D and As = `shear_correction` G t for the thickness t. z counts
/// from the middle of the sheet.
ShellSection isotropic_shell(double youngs_modulus, double poisson_ratio, double density, double thickness,
                             double shear_correction);

/// Section of a laminate by classical lamination theory ([Jon99] chapter 4), about the reference surface z = 0. The
/// first ply is the lowest and begins at z = `bottom`; bottom = -thickness/2 puts the reference surface in the middle.
/// Transverse shear: equilibrium in cylindrical bending along x and along y gives τ(z) = f(z) Q. The complementary
/// energy of τ gives As = (∫ fᵀ G⁻¹ f dz)⁻¹ ([RR97]), which is 5/6 G t for a homogeneous sheet. Requires plies that
/// check_plies() accepts.
ShellSection laminate(const std::vector<Ply>& plies, double bottom);

/// Throws Error unless every ply has finite values with thickness, E1, E2, G12, G13, G23 > 0, density >= 0 and nu12² <
/// E1/E2. The message names the ply and the quantity.
void check_plies(const std::vector<Ply>& plies, const std::string& where);

}  // namespace tisserand::reducer

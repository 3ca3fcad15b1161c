// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of buckling of parts that are reduced to their ends or edges, and what they are held against. Tests and the
// page of verification compute the same thing here.
#pragma once

#include "reducer/mesh/mesh.hpp"
#include "tests/support/meshes/shell_mesh.hpp"

namespace tisserand::reducer {

/// A straight beam along x from the origin, 10 long, mass 1 per length, without shear, boundary "base" and "tip":
/// products of the section with E or G.
struct SlenderBeam {
  double EA = 1e6;
  double GJ = 80.0;
  double EI_y = 100.0;      ///< bending along z
  double EI_z = 200.0;      ///< bending along y
  double density = 1e-4;    ///< ρ/E: rotary inertia of bending is this times EI
  double torsional = 0.03;  ///< added inertia about x per length
};
Mesh slender_beam(const SlenderBeam& beam, int elements);

/// Supports of the two ends; the length of the beam is free to change.
enum class ColumnEnds { pinned, clamped_free, clamped_pinned, clamped };
/// Rows of [base; tip] that are held.
std::vector<int> held_rows(ColumnEnds ends);
/// Load of buckling over π² EI/L²: 1, 1/4, 2.045748, 4.
double euler_factor(ColumnEnds ends);

/// Load of buckling of slender_beam({}, 40), reduced, over Euler's.
double reduced_column(ColumnEnds ends, int modes);

/// EI_y 100 across.
Mesh slender_strip(double EI_z = 1e5);

/// Force along y at the free end of the clamped strip at which it turns over, in 4.0126 √(EI_y GJ)/L².
double reduced_strip(int modes, double EI_z = 1e5);

/// A square box of shells (side 0.1, t 0.005, L 2, ν 0; 8 x 20 cells) between two rigid ends, clamped-free, over
/// Euler's load with shear of the thin-walled section, P_E/(1 + P_E/GA).
double reduced_box_column(int modes);

/// A block of solids 1 x 0.1 x 0.1 between two rigid ends, clamped-free, ν 0: load in that of Euler, and Euler's with
/// shear after Engesser, P_E/(1 + P_E/GA), and Haringx, GA/2 (√(1 + 4 P_E/GA) − 1), in the same.
struct SolidColumn {
  double load = 0.0, engesser = 0.0, haringx = 0.0;
};
SolidColumn reduced_solid_column(SolidShape shape, int cells, int modes);

/// A square plate 1 x 1 (t 0.01, ν 0.3, D 1, `cells` x `cells`), all edges simply supported, reduced to the
/// translations of its edges: loads in π² D/b². Exact: 4 under pressure along x; 9.325 under shear.
enum class PlatePreload { compression, shear };
double full_plate(PlatePreload preload, const ShellMesh& mesh);
double reduced_plate(PlatePreload preload, const ShellMesh& mesh, int modes);
double exact_plate(PlatePreload preload);

/// A panel 1 x 1 (arc) of a cylinder of radius R = 20, t 0.01, ν 0.3, D 1, pressed along its axis; edges simply
/// supported: deflection held, along straight edges the axial, along curved edges the circumferential displacement
/// while it buckles. In π² D/b²; exact for shallow panels with one half wave: 4 + E t b⁴/(4 π⁴ D R²).
double full_panel(int cells);
double reduced_panel(int cells, int modes);
double exact_panel();

}  // namespace tisserand::reducer

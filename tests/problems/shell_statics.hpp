// SPDX-License-Identifier: GPL-3.0-or-later
// Published statics of plates and shells: from a mesh to the number that is printed. Tests and the table of
// verification compute the same thing here.
#pragma once

#include "tests/support/meshes/shell_mesh.hpp"

namespace tisserand::reducer {

/// Vertical displacement (down) at the middle of the free edge of the roof; n x n on a quarter.
double scordelis_lo_roof(const ShellMesh& mesh);

/// Displacement under the load; n x n on an eighth.
double pinched_cylinder(const ShellMesh& mesh);

/// Displacement along one of the forces on a hemisphere of radius 10 with an 18° hole; n x n on a quarter.
double pinched_hemisphere(const ShellMesh& mesh, double thickness);

/// Opening of a slit ring of 72 facets under two opposite forces EI/R² at the slit, over its radius; 3π without
/// stretching.
double ring_opening(Facets facets, double radius_over_thickness);

/// Vertical displacement at the middle of the loaded edge; n x n.
double cooks_membrane(const ShellMesh& mesh);

/// Displacement of the tip along a unit load there (work-conjugate mean over the edge); twist: rotation under a unit
/// torque.
enum class TipLoad { extension, in_plane, out_of_plane, twist };

/// Shapes of the 6 x 1 mesh of the straight beam ([MH85]); finer meshes halve its cells.
enum class Distortion { none, trapezoids, parallelograms };

double straight_beam(const ShellMesh& mesh, Distortion distortion, TipLoad load);  ///< 6n x n
double curved_beam(const ShellMesh& mesh, TipLoad load);                           ///< 6n x n; not twist
double twisted_beam(const ShellMesh& mesh, double thickness, TipLoad load);        ///< 12n x 2n; in and out of plane

/// Central deflection of a plate 2 x `length`, 1e-4 thick, under a pressure of 1e-4 or a force of 4e-4; n x n on a
/// quarter.
enum class PlateEdges { simply_supported, clamped };
enum class PlateLoad { pressure, force };
struct RectangularPlate {
  double length = 2.0;
  PlateEdges edges = PlateEdges::simply_supported;
  PlateLoad load = PlateLoad::pressure;
};
double plate_deflection(const ShellMesh& mesh, const RectangularPlate& plate);

/// NAFEMS LE5, Z section under a torque: axial stress [Pa] at a tip of a flange, x = 2.5; 8n x 4n cells.
double z_section_stress(const ShellMesh& mesh);

/// Slit cylinder turned by T = 1000; 16n x 4n cells.
struct SlitCylinder {
  double axial = 0.0;            ///< displacement of the edges of the slit
  double circumferential = 0.0;  ///< displacement at the turned end
};
SlitCylinder slit_cylinder(const ShellMesh& mesh);

}  // namespace tisserand::reducer

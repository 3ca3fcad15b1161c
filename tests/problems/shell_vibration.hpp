// SPDX-License-Identifier: GPL-3.0-or-later
// Published frequencies of plates and shells, computed from a mesh for the tests and for the verification tables.
#pragma once

#include <Eigen/Core>

#include "tests/support/meshes/shell_mesh.hpp"

namespace tisserand::reducer {

/// NAFEMS FV12, free square plate 10 x 10 x 0.05 m [Hz]: six rigid modes, then eight elastic ones; n x n.
Eigen::VectorXd free_square_plate(const ShellMesh& mesh);

/// NAFEMS FV15, clamped rhombic plate, 45°, side 10 m, 0.05 m thick: six frequencies [Hz]; n x n.
Eigen::VectorXd clamped_rhombic_plate(const ShellMesh& mesh);

/// NAFEMS FV52, plate 10 x 10 x 1 m: four frequencies of bending, simply supported, or six in its plane, free (three
/// rigid modes first) [Hz]; n x n.
Eigen::VectorXd thick_plate_bending(const ShellMesh& mesh);
Eigen::VectorXd thick_plate_in_its_plane(const ShellMesh& mesh);

/// λ = ω a² √(ρh/D) of a thin square plate (h/a = 1e-3), elastic modes only; n x n.
enum class SquareEdges { simply_supported, clamped, free };
Eigen::VectorXd square_plate_parameters(const ShellMesh& mesh, SquareEdges edges);

/// Ratio of the first ω² of this plate, simply supported, to the exact 4π⁴ D/(ρh a⁴).
double square_plate_ratio(const ShellMesh& mesh);

/// Cylinder R 0.1, L 0.4, t 0.01 m, both ends clamped [Hz]: first two modes; 4n x 2n cells around and along.
Eigen::VectorXd clamped_cylinder(const ShellMesh& mesh);

/// Frequency [Hz] of the cylinder's mode that turns about the axis, among its lowest 24. A clamped edge holds the
/// drilling rotation too, which in torsion is half the shear strain: an error of order 1. A hinged edge (translations
/// only) leaves it free. Bending rotations do not matter to this mode.
enum class CylinderEnds { clamped, hinged };
double cylinder_torsion(const ShellMesh& mesh, CylinderEnds ends);

}  // namespace tisserand::reducer

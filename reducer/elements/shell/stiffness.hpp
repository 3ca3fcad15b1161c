// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness of shell elements in their own axes about the corners, from projected geometry and section.
#pragma once

#include <Eigen/Core>

#include "reducer/elements/shell/geometry.hpp"
#include "reducer/properties/shell_section.hpp"

namespace tisserand::reducer {

using QuadMatrix = Eigen::Matrix<double, 24, 24>;
using TriangleMatrix = Eigen::Matrix<double, 18, 18>;

/// Factors of the terms that complete the rank of the membrane. Results hardly depend on them; a test varies them.
struct DrillingFactors {
  double mean = 0.0;       ///< factor of A66 (mean of θz - mean rotation of the plane)² dA ([HB89], at one point)
  double quadratic = 0.0;  ///< factor of the energy of the two quadratic stress modes
};
inline constexpr DrillingFactors usual_drilling{1.0, 1e-3};

/// 24 x 24 stiffness for [u v w θx θy θz] of the projected corners (geometry.corner) of the middle surface. Membrane:
/// assumed stress with Allman's edges. Bending and shear: stabilised MITC4. quad.cpp has the formulas.
QuadMatrix quad_stiffness(const ShellGeometry<4>& geometry, const ShellSection& section,
                          const DrillingFactors& drilling);

/// 18 x 18 stiffness. Membrane: Felippa's optimal triangle. Bending, shear: Katili's DKMT. See triangle.cpp.
TriangleMatrix triangle_stiffness(const ShellGeometry<3>& geometry, const ShellSection& section);

/// [N; M] per unit length, consistent with the stiffness: membrane forces of the linear stress modes (for triangles of
/// the basic part) and moments of the curvature. Quadrilaterals: six rows for each of the points `natural` (natural
/// coordinates, 2 x points). Triangles: at the mean of the corners.
Eigen::MatrixXd quad_resultants(const ShellGeometry<4>& geometry, const ShellSection& section,
                                const Eigen::Matrix2Xd& natural);
Eigen::Matrix<double, 6, 18> triangle_resultants(const ShellGeometry<3>& geometry, const ShellSection& section);

/// Section with a unit sheet in place of a missing membrane or bending stiffness (PSHELL with MID1 or MID2 blank),
/// since the elements divide by it. B = 0 keeps both parts apart.
ShellSection whole_section(ShellSection section);

/// Stiffness of either shape. Rows and columns of a missing membrane or bending stiffness are zero.
template <int Corners>
Eigen::Matrix<double, 6 * Corners, 6 * Corners> shell_stiffness(const ShellGeometry<Corners>& geometry,
                                                                const ShellSection& section);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness of shell elements in their own axes about the corners, from projected geometry and section.
#pragma once

#include <Eigen/Core>

#include "reducer/elements/shell/geometry.hpp"
#include "reducer/properties/shell_section.hpp"

namespace tisserand::reducer {

using QuadMatrix = Eigen::Matrix<double, 24, 24>;
using TriangleMatrix = Eigen::Matrix<double, 18, 18>;

/// Factors of the terms that complete the rank of the membrane stiffness of the quadrilateral. Results hardly depend
/// on them; a test varies them.
struct DrillingFactors {
  /// Factor of A66 (mean of θz − mean rotation of the plane)² times the area ([HB89], at one point).
  double mean = 0.0;
  double quadratic = 0.0;  ///< factor of the energy of the two quadratic stress modes
};
inline constexpr DrillingFactors usual_drilling{1.0, 1e-3};

/// Stiffness of a quadrilateral shell for [u v w θx θy θz] of the projected corners (geometry.corner) of the middle
/// surface. Membrane: assumed stress with Allman's edges. Bending and shear: stabilised MITC4. quad.cpp has the
/// formulas.
QuadMatrix quad_stiffness(const ShellGeometry<4>& geometry, const ShellSection& section,
                          const DrillingFactors& drilling);

/// Stiffness of a triangular shell for [u v w θx θy θz] of its corners. Membrane: Felippa's optimal triangle. Bending
/// and shear: Katili's DKMT. triangle.cpp has the formulas.
TriangleMatrix triangle_stiffness(const ShellGeometry<3>& geometry, const ShellSection& section);

/// Resultants [N; M] per unit length of a quadrilateral shell for the coordinates of its corners ((6 points) x 24).
/// They are consistent with the stiffness: membrane forces of the linear stress modes, and moments of the curvature.
/// `natural`: natural coordinates of the points (2 x points). triangle_resultants() gives them at the mean of the
/// corners, with membrane forces of the basic part.
Eigen::MatrixXd quad_resultants(const ShellGeometry<4>& geometry, const ShellSection& section,
                                const Eigen::Matrix2Xd& natural);
Eigen::Matrix<double, 6, 18> triangle_resultants(const ShellGeometry<3>& geometry, const ShellSection& section);

/// Section in which a unit sheet replaces a missing membrane or bending stiffness (PSHELL with MID1 or MID2 blank),
/// since the elements divide by it. The coupling B is 0, which keeps both parts apart.
ShellSection whole_section(ShellSection section);

/// Stiffness of a triangular or quadrilateral shell. Rows and columns of a missing membrane or bending stiffness are
/// zero.
template <int Corners>
Eigen::Matrix<double, 6 * Corners, 6 * Corners> shell_stiffness(const ShellGeometry<Corners>& geometry,
                                                                const ShellSection& section);

}  // namespace tisserand::reducer

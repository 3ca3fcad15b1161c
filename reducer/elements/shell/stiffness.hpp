// Stiffness of shell elements in their own axes: from projected geometry and section to the matrix about the corners.
#pragma once

#include <Eigen/Core>

#include "reducer/elements/shell/geometry.hpp"
#include "reducer/properties/shell_section.hpp"

namespace tisserand::reducer {

using QuadMatrix = Eigen::Matrix<double, 24, 24>;
using TriangleMatrix = Eigen::Matrix<double, 18, 18>;

/// Factors of what completes the rank of the membrane. Results hardly depend on them: a test varies them.
struct DrillingFactors {
  double mean = 0.0;       ///< of A66 (mean of θz - mean rotation of the plane)² dA ([HB89], at one point)
  double quadratic = 0.0;  ///< of the energy of the two quadratic stress modes
};
inline constexpr DrillingFactors usual_drilling{1.0, 1e-3};

/// Four corners, [u v w θx θy θz] each, at the projected corners (geometry.corner) of the middle surface.
/// Membrane: assumed stress with Allman's edges; bending and shear: stabilised MITC4; see the source file.
QuadMatrix quad_stiffness(const ShellGeometry<4>& geometry, const ShellSection& section,
                          const DrillingFactors& drilling);

/// Three corners. Membrane: Felippa's optimal triangle; bending and shear: Katili's DKMT; see the source file.
TriangleMatrix triangle_stiffness(const ShellGeometry<3>& geometry, const ShellSection& section);

/// [N; M] per unit length, as the stiffness has them: membrane forces of the linear stress modes (of triangles the
/// basic part), moments of the curvature. Quadrilaterals: six rows for each point with natural coordinates `natural`
/// (2 x points); triangles: at the mean of the corners.
Eigen::MatrixXd quad_resultants(const ShellGeometry<4>& geometry, const ShellSection& section,
                                const Eigen::Matrix2Xd& natural);
Eigen::Matrix<double, 6, 18> triangle_resultants(const ShellGeometry<3>& geometry, const ShellSection& section);

/// A sheet without membrane or without bending stiffness (PSHELL with MID1 or MID2 blank): the elements divide by what
/// is missing, so a unit sheet takes its place; B = 0 keeps both parts apart.
ShellSection whole_section(ShellSection section);

/// The stiffness of either shape; rows and columns of what the sheet lacks are cleared.
template <int Corners>
Eigen::Matrix<double, 6 * Corners, 6 * Corners> shell_stiffness(const ShellGeometry<Corners>& geometry,
                                                                const ShellSection& section);

}  // namespace tisserand::reducer

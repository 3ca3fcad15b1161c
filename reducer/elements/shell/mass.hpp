// SPDX-License-Identifier: GPL-3.0-or-later
// Mass of shell elements in their own axes, about the middle surface, from projected geometry and section.
#pragma once

#include <array>

#include <Eigen/Core>

#include "reducer/elements/shell/geometry.hpp"
#include "reducer/properties/shell_section.hpp"

namespace tisserand::reducer {

/// Consistent mass of a shell by ∫ρ|v|² with v = u + z θ × ẑ. Coordinates: [u v w θx θy θz] per corner in element
/// axes, at the node; offset 0 means at the middle surface. u is bilinear (linear in a triangle) plus a bulge of each
/// edge. The bulge ½ s(1−s) d × (θ_j − θ_i) comes from the difference of the rotations at the ends i and j of the
/// edge, with the edge vector d. In the plane the edges are those of Allman ([All84]), which give the drilling
/// rotations the inertia of the material that they move. Across the plane they make the deflection of constant
/// curvature exact. Equal rotations make no bulge, so mass, first moments and inertia of rigid motions are exact. The
/// matrix is positive semidefinite: a field of equal drilling rotations alone has no inertia.
template <int Corners>
Eigen::Matrix<double, 6 * Corners, 6 * Corners> consistent_shell_mass(const ShellGeometry<Corners>& geometry,
                                                                      const ShellSection& section);

/// Lumped mass of a shell: m ∫ N_i dA at each corner with the mass m per area, and rotary inertia ∫ρz²dz ∫ N_i dA
/// about all three axes. The rotary inertia about the normal keeps the matrix positive definite, and diagonal in any
/// axes. Its share of the inertia of a body is below (thickness/size of the body)².
template <int Corners>
Eigen::Matrix<double, 6 * Corners, 6 * Corners> lumped_shell_mass(const ShellGeometry<Corners>& geometry,
                                                                  const ShellSection& section);

/// Integration point of consistent_shell_mass(): displacement Σ N_i u_i + bulge_i × θ_i, rotation Σ N_i θ_i, and area
/// dA of the true (warped) surface.
template <int Corners>
struct ShellMassPoint {
  Eigen::Matrix<double, Corners, 1> N;
  Eigen::Matrix<double, 3, Corners> bulge = Eigen::Matrix<double, 3, Corners>::Zero();
  double dA = 0.0;
};
std::array<ShellMassPoint<4>, 9> shell_mass_points(const ShellGeometry<4>& geometry);
std::array<ShellMassPoint<3>, 6> shell_mass_points(const ShellGeometry<3>& geometry);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Two-node spatial beam element: its 12 x 12 matrices from section, material and length.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "reducer/properties/beam_data.hpp"

namespace tisserand::reducer {

using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Ratio Φ = 12 E I/(G A_s L²) of shear to bending flexibility in both bending planes ([Prz68] 5.6). It is 0 for
/// Euler-Bernoulli and for a shear area of 0.
struct ShearFlexibility {
  double xy = 0.0;  ///< bending in x-y: Iz and shear_area_y
  double xz = 0.0;  ///< bending in x-z: Iy and shear_area_z
};
ShearFlexibility shear_flexibility(const BeamElementData& beam);

/// Whether beam_stiffness() and beam_mass() hold for the beam; elements/beam/general.hpp is for all others. The beam
/// must be prismatic and without added mass. Centroids and shear centres must lie on its axis, and its axes must be
/// principal.
bool is_plain(const BeamElementData& beam);

/// Whether no section of the beam resists bending (Iy = Iz = 0): a rod.
bool is_rod(const BeamElementData& beam);

/// Stiffness of a straight prismatic beam in element axes, exact for loads at its ends ([Prz68] 5.6, eq. (5.116)).
/// Requires is_plain().
Matrix12 beam_stiffness(const BeamElementData& beam);

/// Mass matrix of a straight prismatic beam in element axes. Consistent: ∫ρA Nᵀ N + ρI N_θᵀ N_θ with the shape
/// functions of [FK93] (Hermite for Φ = 0), linear along the axis and in torsion. Lumped: half of the mass of the
/// element at each node, diagonal. Requires is_plain().
Matrix12 beam_mass(const BeamElementData& beam);

/// Axes R_PE of a beam: columns are its x, y, z in part axes. x is along `axis`, and y along the component of
/// `orientation` normal to it. Returns nothing if `orientation` is parallel to the axis (within 1e-6 rad).
std::optional<Eigen::Matrix3d> beam_axes(const Eigen::Vector3d& axis, const Eigen::Vector3d& orientation);

/// Matrix `local` turned from element axes to part axes: Tᵀ K T with T = diag(R_PEᵀ, ...).
Matrix12 to_part_axes(const Matrix12& local, const Eigen::Matrix3d& R_PE);

}  // namespace tisserand::reducer

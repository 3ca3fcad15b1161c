// SPDX-License-Identifier: GPL-3.0-or-later
// Two-node spatial beam element: its 12 x 12 matrices from section, material and length.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "reducer/properties/beam_data.hpp"

namespace tisserand::reducer {

using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Φ = 12 E I/(G A_s L²) of the two bending planes; 0 for Euler-Bernoulli and for a shear area of 0 ([Prz68] 5.6).
struct ShearFlexibility {
  double xy = 0.0;  ///< bending in x-y: Iz and shear_area_y
  double xz = 0.0;  ///< bending in x-z: Iy and shear_area_z
};
ShearFlexibility shear_flexibility(const BeamElementData& beam);

/// Whether the beam is prismatic and without added mass, its axis that of centroids and shear centres, and its axes
/// principal. beam_stiffness() and beam_mass() are for such beams, elements/beam/general.hpp for any.
bool is_plain(const BeamElementData& beam);

/// Whether no section of the beam resists bending (Iy = Iz = 0): a rod.
bool is_rod(const BeamElementData& beam);

/// Stiffness of the straight prismatic beam, exact for loads at its ends ([Prz68] 5.6, eq. (5.116)).
Matrix12 beam_stiffness(const BeamElementData& beam);

/// Mass matrix. Consistent: ∫ρA Nᵀ N + ρI N_θᵀ N_θ with the shape functions of [FK93] (Hermite for Φ = 0), linear along
/// the axis and in torsion. Lumped: half of the element's mass at each node, diagonal.
Matrix12 beam_mass(const BeamElementData& beam);

/// R_PE: columns are the element's x, y, z in part axes. y is the component of `orientation` normal to the axis. Empty
/// if `orientation` is parallel to the axis (within 1e-6 rad).
std::optional<Eigen::Matrix3d> beam_axes(const Eigen::Vector3d& axis, const Eigen::Vector3d& orientation);

/// Tᵀ K T with T = diag(R_PEᵀ, ...): turns a matrix from element axes to part axes.
Matrix12 to_part_axes(const Matrix12& local, const Eigen::Matrix3d& R_PE);

}  // namespace tisserand::reducer

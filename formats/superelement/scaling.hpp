// SPDX-License-Identifier: GPL-3.0-or-later
// Scales that make the entries of S̄ and M̄ comparable, shared by the checks of superelements.
#pragma once

#include <string>

#include <Eigen/Core>

#include "formats/superelement/superelement.hpp"

namespace tisserand::formats {

inline constexpr double rigid_residual_accepted = 1e-9;  ///< kept, unless it strains the softest deformation
inline constexpr double rigid_residual_filtered = 1e-4;  ///< largest residual that projection removes; above: Error
inline constexpr Eigen::Index max_coordinates = 10000;   ///< largest n; limits the memory that a file can request

/// Largest distance of a boundary node from the mean of the boundary nodes, or 1 if it is 0.
double characteristic_length(const Superelement& element);

/// Scales of the congruences D S̄ D / s and D M̄ D / m, which make entries comparable in any consistent units. The
/// diagonal matrix D is 1 for translations and 1/l for rotations. For internal coordinates D gives diagonals equal to
/// the largest boundary entry.
struct ScaledMatrices {
  double length = 1.0;  ///< l, the characteristic length
  double stiffness_scale =
      1.0;  ///< s: max |D S̄ D| over boundary rows, or m ω² of the softest internal coordinate if larger
  double mass_scale = 1.0;        ///< m: max |D M̄ D| over boundary rows
  Eigen::VectorXd stiffness_row;  ///< (n) diagonal of D for S̄
  Eigen::VectorXd mass_row;       ///< (n) diagonal of D for M̄
};

/// Scales of the matrices of a superelement. Requires finite entries and diagonals ≥ 0.
ScaledMatrices scale(const Superelement& element);

/// Rigid motions (n x 6) about the mean of the nodes in scaled coordinates: D⁻¹ R diag(1, 1, 1, l⁻¹, l⁻¹, l⁻¹) with R
/// of rigid_motions(), D of `row_scale` and l = `length`.
Eigen::MatrixXd scaled_rigid_motions(const Superelement& element, const Eigen::VectorXd& row_scale, double length);

/// Description of a row of the matrices: "row 7 (node 'tip', rotation y)" or "row 12 (internal coordinate 0)".
std::string row_text(const Superelement& element, Eigen::Index row);

}  // namespace tisserand::formats

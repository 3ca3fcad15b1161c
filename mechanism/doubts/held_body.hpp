// SPDX-License-Identifier: GPL-3.0-or-later
// A superelement with the boundary conditions of its neighbours: free coordinates and lowest vibration.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Flags of the coordinates of each superelement (boundary, then internal) that joints or other bodies hold. If one
/// node is attached, all its coordinates are held. If several are attached, only their translations are.
std::vector<std::vector<bool>> held_coordinates(const Model& model);

/// Number of the beam to which each superelement belongs. Fixed joints and common nodes weld superelements to one beam.
std::vector<int> welded_beams(const Model& model);

/// Stiffness S and mass matrix M of the n free coordinates of a superelement, in units coordinate_units().
struct FreePart {
  /// Index of each free coordinate among boundary, then internal coordinates (n).
  std::vector<int> free;
  Eigen::VectorXd unit;  ///< unit of each free coordinate (n)
  Eigen::MatrixXd S, M;  ///< stiffness and mass matrix of the free coordinates (n x n)
};
/// Free part of the body, without the coordinates that `held` marks. Empty (n = 0) above 80 coordinates, so that all
/// uses of it take milliseconds.
FreePart free_part(const SuperelementBody& body, const std::vector<bool>& held);

/// Letter of an inertia option: "A", "B", "M", "F".
const char* letter(formats::InertiaOption option);

/// Vibration of a held body with the shape φ, where φᵀMφ = 1.
struct HeldMode {
  double omega = 0.0;     ///< angular frequency [rad/time]; 0: no vibration
  Eigen::VectorXd shape;  ///< shape φ: boundary coordinates, then internal ones
};

/// Lowest vibration of the reduced body with the coordinates `held` fixed, apart from remaining rigid motions. Only
/// frequencies above `from`/1000 [rad/time] count. None (ω = 0) if the body is not positive definite or has more than
/// 80 coordinates.
HeldMode first_mode(const SuperelementBody& body, const std::vector<bool>& held, double from);

}  // namespace tisserand::mechanism

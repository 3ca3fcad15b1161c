// SPDX-License-Identifier: GPL-3.0-or-later
// A superelement with the boundary conditions of its neighbours: free coordinates and lowest vibration.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Coordinates of each superelement (boundary, then internal) that others hold. These are all coordinates of its only
/// attached node, or the translations of several.
std::vector<std::vector<bool>> held_coordinates(const Model& model);

/// Index of the beam that each superelement belongs to: fixed joints and common nodes weld superelements together.
std::vector<int> welded_beams(const Model& model);

/// Matrices S and M of the n free coordinates, in coordinate_units().
struct FreePart {
  std::vector<int> free;  ///< n: index among boundary, then internal coordinates
  Eigen::VectorXd unit;   ///< n
  Eigen::MatrixXd S, M;   ///< n x n
};
/// Free part of the body. Empty (n = 0) above 80 coordinates, so that all uses of it take milliseconds.
FreePart free_part(const SuperelementBody& body, const std::vector<bool>& held);

/// Letter of the option: "A", "B", "M", "F".
const char* letter(formats::InertiaOption option);

/// A vibration φ with φᵀMφ = 1.
struct HeldMode {
  double omega = 0.0;     ///< [rad/time]; 0: no vibration
  Eigen::VectorXd shape;  ///< φ: boundary coordinates, then internal ones
};

/// Lowest vibration above `from`/1000 of the reduced body with the marked coordinates held, without its rigid motions.
/// None if the body is not positive definite or has more than 80 coordinates.
HeldMode first_mode(const SuperelementBody& body, const std::vector<bool>& held, double from);

}  // namespace tisserand::mechanism

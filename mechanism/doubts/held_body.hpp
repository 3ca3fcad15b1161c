// A superelement as its neighbours hold it: what is left free, and its lowest vibration.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Which coordinates of each superelement (boundary, then internal) others hold: all of the only node that is attached
/// to something, or the translations of several.
std::vector<std::vector<bool>> held_coordinates(const Model& model);

/// The beam that each superelement is part of: fixed joints and common nodes weld them together.
std::vector<int> welded_beams(const Model& model);

/// S and M of the n coordinates that are not held, in coordinate_units().
struct FreePart {
  std::vector<int> free;  ///< n: index among boundary, then internal coordinates
  Eigen::VectorXd unit;   ///< n
  Eigen::MatrixXd S, M;   ///< n x n
};
/// None (n = 0) where there would be more than 80 coordinates: all done with it takes milliseconds.
FreePart free_part(const SuperelementBody& body, const std::vector<bool>& held);

/// "A", "B", "M", "F".
const char* letter(formats::InertiaOption option);

/// A vibration φ with φᵀMφ = 1.
struct HeldMode {
  double omega = 0.0;     ///< [rad/time]; 0: there is none
  Eigen::VectorXd shape;  ///< φ: boundary coordinates, then internal ones
};

/// Lowest vibration above `from`/1000 of the reduced body whose marked coordinates are held, without its rigid motions.
/// None where the body is not positive definite or has more than 80 coordinates.
HeldMode first_mode(const SuperelementBody& body, const std::vector<bool>& held, double from);

}  // namespace tisserand::mechanism

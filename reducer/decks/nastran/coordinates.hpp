// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinate systems of a Nastran deck: origins and axes in the part frame from the chain of CORD cards.
#pragma once

#include <map>
#include <numbers>
#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer {

inline constexpr double degree = std::numbers::pi / 180.0;

/// Kind of a coordinate system, by its coordinates: x y z (rectangular), r θ z (cylindrical), or ρ θ φ with θ from the
/// z axis (spherical). Angles are in degrees.
enum class FrameKind { rectangular, cylindrical, spherical };

/// Coordinate system of a Nastran deck.
struct NastranFrame {
  FrameKind kind = FrameKind::rectangular;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();    ///< origin in the part frame
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: x, y, z in part axes
};

/// Position in the part frame of the point with the coordinates `coordinates` in `frame`.
Eigen::Vector3d frame_point(const NastranFrame& frame, const Eigen::Vector3d& coordinates);

/// Axes (columns, part axes) of the components of a vector at `position` (part frame): x y z, e_r e_θ e_z, or e_ρ e_θ
/// e_φ. On the z axis of a cylindrical or spherical system they are not defined. There they are those of the
/// half-plane θ = 0 (spherical: φ = 0).
Eigen::Matrix3d frame_axes_at(const NastranFrame& frame, const Eigen::Vector3d& position);

/// Coordinate systems of a deck. Index 0 is the basic system, which is the part frame.
struct NastranFrames {
  std::vector<NastranFrame> frames{NastranFrame{}};
  std::map<long, int> row_of_id{{0, 0}};

  /// Index in `frames` of the system with the number `id`, or −1.
  int find(long id) const {
    const auto found = row_of_id.find(id);
    return found == row_of_id.end() ? -1 : found->second;
  }
};

}  // namespace tisserand::reducer

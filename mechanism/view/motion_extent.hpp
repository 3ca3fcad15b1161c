// SPDX-License-Identifier: GPL-3.0-or-later
// Size of the moving objects, and the body that a camera follows.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "formats/page/surface.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

/// Boxes around all that moves in a run: nodes, frames, shapes, and markers on the ground. One box holds all instants,
/// others hold one instant each, for some instants. Roads are not included.
class MotionExtent {
 public:
  /// Makes the boxes of nodes, frames of bodies, and markers on the ground.
  explicit MotionExtent(const ViewedRun& run);

  /// Adds an undeformed shape to the boxes. `frame`: motion of its frame.
  void add(const formats::Surface& surface, const Track& frame);

  /// Box over all instants.
  const Eigen::AlignedBox3d& box() const { return box_; }
  /// Largest diagonal of a box at one instant.
  double size() const;
  /// Index of the heaviest body whose path spans more than half of box(), for a camera to follow. −1: box() is not
  /// several times larger than size(), so the camera may stay.
  int followed() const;

 private:
  const ViewedRun& run_;
  std::vector<std::size_t> rows_;
  Eigen::AlignedBox3d box_;
  std::vector<Eigen::AlignedBox3d> at_;  ///< boxes at the instants `rows_`
};

}  // namespace tisserand::mechanism

// SPDX-License-Identifier: GPL-3.0-or-later
// Size of the moving objects, and the body that a camera follows.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "formats/page/surface.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

/// Boxes around nodes, frames, shapes and markers on the ground: over all instants, and at some of them. Roads are not
/// included.
class MotionExtent {
 public:
  /// Boxes of nodes, frames of bodies, and markers on the ground.
  explicit MotionExtent(const ViewedRun& run);

  /// Adds an undeformed shape at some of the instants.
  void add(const formats::Surface& surface, const Track& frame);

  const Eigen::AlignedBox3d& box() const { return box_; }
  /// Largest diagonal at one instant.
  double size() const;
  /// Body to follow if all bodies leave their place (the path is several times `size()`): the heaviest body that moves
  /// this far. -1: the camera may stay.
  int followed() const;

 private:
  const ViewedRun& run_;
  std::vector<std::size_t> rows_;
  Eigen::AlignedBox3d box_;
  std::vector<Eigen::AlignedBox3d> at_;  ///< boxes at rows_
};

}  // namespace tisserand::mechanism

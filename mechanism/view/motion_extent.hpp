// How large what moves is, and which body a camera follows.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "formats/page/surface.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

/// Boxes about nodes, frames, shapes and what is held on the ground: over all instants, and at some of them. Ground
/// that is rolled on is no part of it.
class MotionExtent {
 public:
  /// Nodes, frames of bodies, and markers on the ground.
  explicit MotionExtent(const ViewedRun& run);

  /// An undeformed shape at some of the instants.
  void add(const formats::Surface& surface, const Track& frame);

  const Eigen::AlignedBox3d& box() const { return box_; }
  /// The largest diagonal at one instant.
  double size() const;
  /// Where all bodies leave their place, so that the whole way is several times `size()`: the heaviest body that moves
  /// so far. -1: a camera may stand.
  int followed() const;

 private:
  const ViewedRun& run_;
  std::vector<std::size_t> rows_;
  Eigen::AlignedBox3d box_;
  std::vector<Eigen::AlignedBox3d> at_;  ///< of rows_
};

}  // namespace tisserand::mechanism

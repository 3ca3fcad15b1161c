// Time histories of chosen nodes, as CSV.
#pragma once

#include <string>
#include <vector>

#include "reducer/recover/envelope.hpp"

namespace tisserand::reducer {

/// R_0, times the instant: axes of the floating frame in the world; 1 in the part frame.
Eigen::Matrix3d frame_axes(const BodyMotion& motion, RecoverFrame frame, Eigen::Index instant);

/// One line per instant: time, then per point displacement x, y, z (axes of the frame asked for), position, and the
/// largest von Mises (beams: normal) stress of the elements at the node.
class PointHistory {
 public:
  PointHistory(const formats::Recovery& recovery, const BodyMotion& motion, const RecoverRequest& request);

  bool empty() const { return nodes_.empty(); }
  /// `rest`: places of the nodes without deformation.
  void add(const RecoveredFields& fields, const InstantValues& values, const Eigen::Matrix3Xd& rest,
           const Eigen::Matrix3d& axes, Eigen::Index instant, double time);
  const std::string& text() const { return text_; }

 private:
  std::vector<int> nodes_;
  std::vector<std::vector<int>> around_;  ///< elements at each
  std::string text_;
};

}  // namespace tisserand::reducer

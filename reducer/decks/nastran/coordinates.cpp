// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinate systems of a Nastran deck: origins and axes in the part frame from the chain of CORD cards.
#include "reducer/decks/nastran/coordinates.hpp"

#include <cmath>

namespace tisserand::reducer {

Eigen::Vector3d frame_point(const NastranFrame& frame, const Eigen::Vector3d& x) {
  Eigen::Vector3d local = x;
  switch (frame.kind) {
    case FrameKind::rectangular:
      break;
    case FrameKind::cylindrical:
      local = {x(0) * std::cos(x(1) * degree), x(0) * std::sin(x(1) * degree), x(2)};
      break;
    case FrameKind::spherical: {
      const double r = x(0) * std::sin(x(1) * degree);
      local = {r * std::cos(x(2) * degree), r * std::sin(x(2) * degree), x(0) * std::cos(x(1) * degree)};
      break;
    }
  }
  return frame.origin + frame.axes * local;
}

Eigen::Matrix3d frame_axes_at(const NastranFrame& frame, const Eigen::Vector3d& position) {
  if (frame.kind == FrameKind::rectangular) return frame.axes;
  const Eigen::Vector3d local = frame.axes.transpose() * (position - frame.origin);
  const double r = std::hypot(local(0), local(1));
  const bool on_axis = r <= 1e-12 * local.norm();
  const double c = on_axis ? 1.0 : local(0) / r, s = on_axis ? 0.0 : local(1) / r;
  Eigen::Matrix3d turned;
  if (frame.kind == FrameKind::cylindrical) {
    turned << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  } else {
    const double theta = std::atan2(on_axis ? 0.0 : r, local(2));
    const double ct = std::cos(theta), st = std::sin(theta);
    turned << st * c, ct * c, -s, st * s, ct * s, c, ct, -st, 0.0;
  }
  return frame.axes * turned;
}

}  // namespace tisserand::reducer

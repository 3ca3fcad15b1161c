// SPDX-License-Identifier: GPL-3.0-or-later
// Lines and arcs of part.yaml as curves, and the axes of beams along them.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "formats/part/part.hpp"

namespace tisserand::reducer {

/// Curve X(s) of a line of part.yaml, with s in [0, 1] at constant speed. It is a straight line, or the arc center + r
/// (cos(s angle) e1 + sin(s angle) e2) with the radius r.
struct Curve {
  Eigen::Vector3d from, to;
  double angle = 0.0;  ///< angle of the arc [rad]; 0: straight
  double radius = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero(), e1 = Eigen::Vector3d::Zero(), e2 = Eigen::Vector3d::Zero();

  double length() const;
  Eigen::Vector3d at(double s) const;
};

/// Curve of a beam between the positions `from` and `to` of its ends. Throws Error for zero length and for collinear
/// points of an arc.
Curve curve_of(const formats::BeamLine& line, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// Number of equal elements of a beam line, which the part file gives directly or by an element size. Throws Error if
/// there are too many, or too few for an arc.
int element_count(const Curve& curve, const formats::BeamLine& line);

/// Axis x, y or z of the part that is most nearly normal to all of the unit vectors `tangents`, by the rule of PART.md
/// (ties: y before z before x).
Eigen::Vector3d default_orientation(const std::vector<Eigen::Vector3d>& tangents);

}  // namespace tisserand::reducer

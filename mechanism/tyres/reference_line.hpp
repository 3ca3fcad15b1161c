// SPDX-License-Identifier: GPL-3.0-or-later
// Reference line of a curved road, and the coordinates of points along it and beside it.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/math/count.hpp"

namespace tisserand::mechanism {

/// Coordinates of a point of the plane relative to a line: u along the line, v to its left, with gradients by x and y.
struct LinePlace {
  double u = 0.0, v = 0.0;
  Eigen::Vector2d u_by, v_by;
};

/// Reference line r(u) of a road: the cubic spline through points at equal steps of u. The curvature of the line is
/// constant in the first and last interval, and continuous between its ends. Beyond its ends it continues straight. So
/// the coordinates u and v of a point p have continuous gradients. v is the distance of p from r(u), u belongs to the
/// nearest point of the line:
/// (p − r)·r' = 0, v = (p − r)·n, ∇u = r'/(r'·r' − (p − r)·r''), ∇v = n, n = r' turned to the left, |n| = 1.
class ReferenceLine {
 public:
  /// Makes the line through `points` (2 x 2 or more), at equal steps of u from `u_begin` to `u_end`.
  ReferenceLine(const Eigen::Matrix2Xd& points, double u_begin, double u_end);

  /// Coordinates u and v of p. The cost is logarithmic in the number of points. Of equally near branches the first
  /// counts.
  LinePlace find(const Eigen::Vector2d& p) const;
  /// Point with the coordinates u and v.
  Eigen::Vector2d point(double u, double v) const;

  /// Value of u at which the line bends too much for a strip from `v_right` to `v_left` beside it, or not-a-number if
  /// there is none. There 1 − κ v with the curvature κ is below the limit that find() needs.
  double sharp_bend(double v_right, double v_left) const;

 private:
  struct At {
    Eigen::Vector2d r, d1, d2;
  };
  struct Nearest {
    double distance;  ///< squared distance
    int point;
  };
  int last() const { return count_of(points_) - 1; }
  At at(double u) const;
  void build(int box, int first, int end);
  void search(int box, int first, int end, const Eigen::Vector2d& p, Nearest& nearest) const;

  double u_begin_, step_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<Eigen::Vector2d> second_;     ///< r'' at the points
  std::vector<Eigen::AlignedBox2d> boxes_;  ///< around points: halves of box b are 2 b + 1 and 2 b + 2
};

}  // namespace tisserand::mechanism

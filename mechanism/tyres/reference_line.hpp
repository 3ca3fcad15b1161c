// The line along which the heights of a curved road are given, and how points of the plane are found from it.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/math/count.hpp"

namespace tisserand::mechanism {

/// A point of the plane along the line (u) and to its left (v), with gradients in x and y.
struct LinePlace {
  double u = 0.0, v = 0.0;
  Eigen::Vector2d u_by, v_by;
};

/// r(u): the cubic spline through points at equal steps of u, with constant curvature in its first and last interval,
/// going on straight beyond its ends. Its curvature is continuous between them, so that u and v have continuous
/// gradients. v is the distance from r(u), u that of the nearest point:
///   (p − r)·r' = 0,  v = (p − r)·n,  ∇u = r'/(r'·r' − (p − r)·r''),  ∇v = n,  n = r' turned to the left, |n| = 1.
class ReferenceLine {
 public:
  /// `points`: two or more, of u from u_begin to u_end.
  ReferenceLine(const Eigen::Matrix2Xd& points, double u_begin, double u_end);

  /// Cost: logarithmic in the number of points. Where branches of the line are equally near, the first counts.
  LinePlace find(const Eigen::Vector2d& p) const;
  Eigen::Vector2d point(double u, double v) const;

  /// A u at which the line bends more than a strip from v_right to v_left on its sides can: 1 − κ v below the limit
  /// that find() needs. Not-a-number: none.
  double sharp_bend(double v_right, double v_left) const;

 private:
  struct At {
    Eigen::Vector2d r, d1, d2;
  };
  struct Nearest {
    double distance;  ///< squared
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

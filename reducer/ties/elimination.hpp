// SPDX-License-Identifier: GPL-3.0-or-later
// Exact elimination of linear equations: choice of dependent coordinates, as sums over the others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reducer/ties/equations.hpp"

namespace tisserand::reducer {

/// Transformation x = T q from independent coordinates q to all coordinates x. A coordinate x is one of q, or a sum
/// over q.
struct Transformation {
  int independent = 0;                       ///< number of coordinates q, whose order is that of their x
  std::vector<int> row;                      ///< for each x: its q, or −1 − (row of `dependent`)
  std::vector<std::vector<Term>> dependent;  ///< sum Σ coefficient q of each dependent x; empty: always 0
  std::vector<int> source;                   ///< for each q: the x that it is
};

/// Result of eliminate(): the transformation, and the equations and coordinates that it used.
struct Elimination {
  Transformation T;
  int redundant = 0;           ///< number of equations that other equations imply
  std::vector<int> equation;   ///< indices of the equations that are not redundant
  std::vector<int> dependent;  ///< coordinates x that these equations made dependent, one each
};

/// Function that names a coordinate in messages.
using CoordinateNames = std::function<std::string(int coordinate)>;

/// Eliminates the equations of ties one by one (Gauss-Jordan). The preferred coordinate of an equation becomes
/// dependent, unless the coefficient of another one, scaled to a length, is more than ten times as large. Coordinates
/// of the boundary never become dependent. Equations that vanish within 1e-9 are redundant. Throws Error for equations
/// that relate boundary coordinates only, with the names of their ties.
Elimination eliminate(const TieSystem& ties, const std::vector<int>& boundary, const CoordinateNames& name,
                      const std::string& where);

/// Values x = T q (one column per column of `q`).
Eigen::MatrixXd expand(const Transformation& T, const Eigen::MatrixXd& q);

/// Forces Tᵀ f on q that do the work of forces f on x. Missing last rows of `f` are 0.
Eigen::MatrixXd gather(const Transformation& T, const Eigen::MatrixXd& f);

}  // namespace tisserand::reducer

// SPDX-License-Identifier: GPL-3.0-or-later
// Exact elimination of linear equations: choice of dependent coordinates, as sums over the others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reducer/ties/equations.hpp"

namespace tisserand::reducer {

/// Transformation x = T q: a coordinate x is one of q, or a sum over q.
struct Transformation {
  int independent = 0;                       ///< number of q; ascending with x
  std::vector<int> row;                      ///< of each x: its q, or −1 − (row of `dependent`)
  std::vector<std::vector<Term>> dependent;  ///< Σ coefficient q; empty: always 0
  std::vector<int> source;                   ///< x of each q
};

/// Result of the elimination.
struct Elimination {
  Transformation T;
  int redundant = 0;           ///< equations that others imply
  std::vector<int> equation;   ///< numbers of the other equations
  std::vector<int> dependent;  ///< coordinates x that these made dependent, one each
};

/// Function that names coordinates in messages.
using CoordinateNames = std::function<std::string(int coordinate)>;

/// Gauss-Jordan elimination, equation by equation. The preferred coordinate becomes dependent unless another one,
/// scaled to a length, has a coefficient more than ten times as large. Coordinates of the boundary never become
/// dependent. Equations that vanish within 1e-9 are redundant. Throws Error for equations that relate boundary
/// coordinates only, with the names of their ties.
Elimination eliminate(const TieSystem& ties, const std::vector<int>& boundary, const CoordinateNames& name,
                      const std::string& where);

/// Values x = T q (one column per column of q).
Eigen::MatrixXd expand(const Transformation& T, const Eigen::MatrixXd& q);

/// Forces Tᵀ f on q that do the work of forces f on x (missing last rows of f are 0).
Eigen::MatrixXd gather(const Transformation& T, const Eigen::MatrixXd& f);

}  // namespace tisserand::reducer

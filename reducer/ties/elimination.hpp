// Exact elimination of linear equations: which coordinates become dependent, and how they follow the others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reducer/ties/equations.hpp"

namespace tisserand::reducer {

/// x = T q: a coordinate x is one of q, or a sum over q.
struct Transformation {
  int independent = 0;                       ///< number of q; ascending with x
  std::vector<int> row;                      ///< per x: its q, or −1 − (row of `dependent`)
  std::vector<std::vector<Term>> dependent;  ///< Σ coefficient q; empty: always 0
  std::vector<int> source;                   ///< x of each q
};

/// What elimination did.
struct Elimination {
  Transformation T;
  int redundant = 0;           ///< equations that others imply
  std::vector<int> equation;   ///< the others
  std::vector<int> dependent;  ///< coordinates x that they made dependent, as many
};

/// Names coordinates in messages.
using CoordinateNames = std::function<std::string(int coordinate)>;

/// Gauss-Jordan elimination, equation by equation. The dependent coordinate is the preferred one unless another one,
/// scaled to a length, has a coefficient more than ten times as large; coordinates of the boundary never become
/// dependent. Equations that vanish within 1e-9 are redundant. Throws Error for equations that leave relations between
/// boundary coordinates only, with the names of the ties behind them.
Elimination eliminate(const TieSystem& ties, const std::vector<int>& boundary, const CoordinateNames& name,
                      const std::string& where);

/// T q: values of x (one column per column of q).
Eigen::MatrixXd expand(const Transformation& T, const Eigen::MatrixXd& q);

/// Tᵀ f: forces on q that do the work of forces on x (rows beyond those of f are 0).
Eigen::MatrixXd gather(const Transformation& T, const Eigen::MatrixXd& f);

}  // namespace tisserand::reducer

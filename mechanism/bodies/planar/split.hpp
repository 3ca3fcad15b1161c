// SPDX-License-Identifier: GPL-3.0-or-later
// Split of a body into motion in a plane and motion out of it.
#pragma once

#include <string>

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Reason why a body does not stay in the plane: "entry 0.2 of its stiffness ...".
struct LeavesPlane {
  std::string what;
};

/// Largest coupling that counts as zero, relative to the diagonals or to the largest entry.
inline constexpr double planar_share = 1e-10;

/// Basis of the coordinates of a body: columns in the plane, and the others.
struct Split {
  Eigen::MatrixXd in, out;
};

/// Throws LeavesPlane if the largest entry is not negligible against `size`.
void require_nothing(const Eigen::MatrixXd& part, double size, const std::string& what);

/// Couplings of each mode (a column) in the plane and out of it, in units in which 1 is the mass of a mode.
struct ModePulls {
  Eigen::MatrixXd in, out;
};

/// Splits modes into those in the plane and those out of it, as orthonormal combinations of modes of one frequency.
/// `stiffness` is ω², ascending; `kind` is "internal mode" or "mode". A mode without couplings counts as out of the
/// plane, because nothing in the plane moves it. Throws LeavesPlane for a mode with both couplings.
Split split_modes(const ModePulls& pulls, const Eigen::VectorXd& stiffness, const std::string& kind);

}  // namespace tisserand::mechanism

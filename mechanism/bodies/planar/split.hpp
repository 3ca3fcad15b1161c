// SPDX-License-Identifier: GPL-3.0-or-later
// Split of a body into motion in a plane and motion out of it.
#pragma once

#include <string>

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Exception: the reason why a body does not stay in the plane, such as "entry 0.2 of its stiffness ...".
struct LeavesPlane {
  std::string what;
};

/// Largest coupling that counts as zero, relative to the diagonals or to the largest entry.
inline constexpr double planar_share = 1e-10;

/// Basis of the coordinates of a body: columns `in` are motions in the plane, columns `out` motions out of it.
struct Split {
  Eigen::MatrixXd in, out;
};

/// Throws LeavesPlane if the largest entry of `part` exceeds planar_share · `size`. `what`: name of the part in the
/// message.
void require_nothing(const Eigen::MatrixXd& part, double size, const std::string& what);

/// Couplings of each mode (one column each) with other motions of the body: with motion in the plane (`in`) and out of
/// it (`out`). The rows are masses and moments of a mode, scaled so that a mode of mass 1 has entries of at most 1.
struct ModePulls {
  Eigen::MatrixXd in, out;
};

/// Splits modes into those in the plane and those out of it, as orthonormal combinations of modes of one frequency.
/// `stiffness`: ω² of the modes, ascending. `kind`: "internal mode" or "mode", for messages. A mode without couplings
/// counts as out of the plane, because nothing in the plane moves it. Throws LeavesPlane for a mode that couples with
/// both motions.
Split split_modes(const ModePulls& pulls, const Eigen::VectorXd& stiffness, const std::string& kind);

}  // namespace tisserand::mechanism

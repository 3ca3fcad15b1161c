// Splits a body into motion in a plane and motion out of it.
#pragma once

#include <string>

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Why a body does not stay in the plane: "entry 0.2 of its stiffness ...".
struct LeavesPlane {
  std::string what;
};

/// Couplings up to this share of the diagonals, or of the largest entry, count as zero.
inline constexpr double planar_share = 1e-10;

/// Columns of the coordinates of a body: those in the plane, and the others.
struct Split {
  Eigen::MatrixXd in, out;
};

/// Throws LeavesPlane if the largest entry is not negligible against `size`.
void require_nothing(const Eigen::MatrixXd& part, double size, const std::string& what);

/// Couplings of each mode (a column) in the plane and out of it, in units in which 1 is the mass of a mode.
struct ModePulls {
  Eigen::MatrixXd in, out;
};

/// The modes in the plane and those out of it, orthonormal combinations of modes of one frequency; `stiffness`: ω²,
/// ascending; `kind`: "internal mode", "mode". A mode without couplings counts as out of it: nothing in the plane moves
/// it. Throws LeavesPlane for a mode with both couplings.
Split split_modes(const ModePulls& pulls, const Eigen::VectorXd& stiffness, const std::string& kind);

}  // namespace tisserand::mechanism

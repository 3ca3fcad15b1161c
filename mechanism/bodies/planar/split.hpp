// What of a body stays in a plane and what leaves it.
#pragma once

#include <string>

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Why a body does not stay in the plane: "entry 0.2 of its stiffness ...".
struct LeavesPlane {
  std::string what;
};

/// Of diagonals, or of the largest entry: nothing.
inline constexpr double planar_share = 1e-10;

/// Columns of the coordinates of a body: those in the plane, and the others.
struct Split {
  Eigen::MatrixXd in, out;
};

/// Throws LeavesPlane unless the largest entry is nothing beside `size`.
void require_nothing(const Eigen::MatrixXd& part, double size, const std::string& what);

/// What each mode (a column) pulls at in the plane and out of it, in units in which 1 is the mass of a mode.
struct ModePulls {
  Eigen::MatrixXd in, out;
};

/// The modes in the plane and those out of it, orthonormal combinations of modes of one frequency; `stiffness`: ω²,
/// ascending; `kind`: "internal mode", "mode". A mode that pulls at nothing is out of it: nothing in the plane moves
/// it. Throws LeavesPlane for one that pulls at both.
Split split_modes(const ModePulls& pulls, const Eigen::VectorXd& stiffness, const std::string& kind);

}  // namespace tisserand::mechanism

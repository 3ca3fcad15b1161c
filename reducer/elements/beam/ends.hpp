// SPDX-License-Identifier: GPL-3.0-or-later
// Connection of a beam to its nodes: released end forces and rigid arms.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "reducer/elements/beam/general.hpp"

namespace tisserand::reducer {

/// Condenses the released end forces out of stiffness and mass, exactly: u_r = −S_rr⁺ S_rk u_k for released
/// coordinates r and kept ones k. Rows and columns of released coordinates become zero. `released`: bit k is 1 if the
/// k-th end force is zero. Returns the number of motions of released coordinates that no stiffness resists, such as
/// for both axial forces. The caller must treat such a release as an error; the matrices are then those of the
/// pseudoinverse.
int release_ends(std::uint16_t released, BeamMatrices& matrices);

/// Transformation T of release_ends(), which gives the motion of all end coordinates from that of the ends of the
/// arms. `loose`: number of motions that no stiffness resists.
struct Released {
  Matrix12 T = Matrix12::Identity();
  int loose = 0;
};
Released release(std::uint16_t released, const Matrix12& stiffness);

/// Transforms `matrix` from the ends of the beam to its nodes by u_end = u_node + θ × arm. The arms lead from node to
/// end, in the axes of the matrix.
void move_to_nodes(const Eigen::Vector3d& first_arm, const Eigen::Vector3d& second_arm, Matrix12& matrix);

}  // namespace tisserand::reducer
